// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "cloud_sample.h"
#include "ground_checks.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/segmentation/up.h"
#include "plane_search.h"
#include "polar_cells.h"
#include "up_frame.h"

namespace pcl_bv {
using namespace detail;
namespace {

using Eigen::Vector3d;

constexpr std::size_t kSample = 1024;
constexpr std::size_t kFewPoints = 100;  // too few to judge a sensor position
constexpr double kNear = 12.5;           // metres; radius of the first search for the plane around the sensor
constexpr double kNearShare = 0.05, kDenseShare = 0.5;

/// Points seen from above, relative to the assumed position of the sensor: (u, v, 0).
using FlatPoints = std::vector<Vector3d>;

void sample_from_above(const PointView& points, const UpFrame& frame, const Vector3d& assumed,
                       FlatPoints& flat) {
  draw_sample(points, 1, kSample, flat);
  std::erase_if(flat, [&](const Vector3d& p) { return p.isZero(0) || p == assumed; });
  for (Vector3d& p : flat)
    p = Vector3d(dot3(p - assumed, frame.u), dot3(p - assumed, frame.v), 0);
}

/// Returns the share of the points within `radius` of `position`.
double share_near(const FlatPoints& points, const Vector3d& position, double radius) {
  const auto near = std::count_if(points.begin(), points.end(), [&](const Vector3d& p) {
    return (p - position).squaredNorm() < radius * radius;
  });
  return static_cast<double>(near) / static_cast<double>(points.size());
}

/// Returns the mean of the points within kNear of `position`, or `position` if there are none.
Vector3d mean_near(const FlatPoints& points, const Vector3d& position) {
  Vector3d sum = Vector3d::Zero();
  double count = 0;
  for (const Vector3d& p : points) {
    if ((p - position).squaredNorm() >= kNear * kNear) continue;
    sum += p;
    ++count;
  }
  return count > 0 ? Vector3d(sum / count) : position;
}

/// Returns the position where the points are densest. The position is first the centre of the square of 25 m
/// with most points; squares are 12.5 m apart and overlap. The position is then replaced twice by the mean of
/// the points within kNear of it.
Vector3d densest_position(const FlatPoints& points) {
  using Square = std::pair<double, double>;
  std::array<Square, 4 * kSample> corners;  // for each point, the four corners of its grid cell
  auto end_of_all = corners.begin();
  for (const Vector3d& p : points) {
    const Square cell{std::floor(p.x() / kNear), std::floor(p.y() / kNear)};
    for (const auto& [x, y] : {Square(0, 0), Square(1, 0), Square(0, 1), Square(1, 1)})
      *end_of_all++ = {cell.first + x, cell.second + y};
  }
  std::sort(corners.begin(), end_of_all);
  Square best{};
  std::ptrdiff_t largest = 0;
  for (auto begin = corners.begin(); begin != end_of_all;) {
    const auto end = std::upper_bound(begin, end_of_all, *begin);
    if (end - begin > largest) {
      largest = end - begin;
      best = *begin;
    }
    begin = end;
  }
  const Vector3d middle(best.first * kNear, best.second * kNear, 0);
  return mean_near(points, mean_near(points, middle));
}

bool lies_around_assumed(const FlatPoints& points, const Vector3d& densest) {
  const double near = share_near(points, Vector3d::Zero(), kNear);
  if (near >= kNearShare) return true;
  const bool some = share_near(points, Vector3d::Zero(), 2 * kNear) >= kNearShare;
  return some && share_near(points, densest, kNear) < kDenseShare;
}

}  // namespace

SensorPosition find_sensor(const PointView& points, const Vector3d& up, const Vector3d& assumed,
                           GroundScratch& scratch) {
  const FloatEnvironment environment;
  const UpFrame frame(up);
  for (int axis = 0; axis < 3; ++axis)
    require(std::abs(assumed[axis]) <= kMaxCoordinate, "find_sensor", "a coordinate of the assumed position",
            assumed[axis], "from -1e100 to 1e100");
  FlatPoints& flat = scratch.sample;
  sample_from_above(points, frame, assumed, flat);
  SensorPosition result{assumed};
  if (flat.size() < kFewPoints) return result;
  constexpr double edge = ring_width * (ring_count - 1);
  Vector3d at = Vector3d::Zero();
  if (share_near(flat, at, kNear) < kNearShare) {
    const Vector3d densest = densest_position(flat);
    result.confirmed = lies_around_assumed(flat, densest);
    if (!result.confirmed) {
      at = densest;
      result.position += at.x() * frame.u + at.y() * frame.v;
    }
  }
  result.far_share = 1 - share_near(flat, at, edge);
  return result;
}

std::optional<OtherUp> find_other_up(const PointView& points, const GroundPlaneOptions& options,
                                     const Vector3d& sensor, double found) {
  constexpr double min_height = 0.2, min_share = 0.03, max_share = 0.95, max_below_share = 0.1;
  const FloatEnvironment environment;
  const Vector3d up = normalized_up(options.up);
  GroundPlaneOptions search = options;
  search.sensor_height.reset();
  GroundScratch scratch;
  std::vector<Vector3d> directions{{0, 0, 1}, {0, -1, 0}, {0, 1, 0},  {0, 0, -1},
                                   {1, 0, 0}, {-1, 0, 0}, {0, -1, -1}};
  if (found > 0) directions = {-options.up};
  for (const Vector3d& direction : directions) {
    search.up = direction;
    if (dot3(normalized_up(direction), up) > 0.9) continue;
    const std::optional<Plane> plane = find_ground_plane(points, sensor, search, scratch, 2048);
    if (!plane || height_above(*plane, sensor) < min_height) continue;
    draw_sample(points, search.seed, kSample, scratch.sample);
    double near = 0, below = 0;
    for (const Vector3d& p : scratch.sample) {
      const double height = height_above(*plane, p);
      near += std::abs(height) <= search.distance;
      below += height < -search.distance;
    }
    const double share = near / static_cast<double>(scratch.sample.size());
    if (share >= std::max(min_share, 3 * found) && share <= max_share && below <= max_below_share * near)
      return OtherUp{direction, share};
  }
  return {};
}

}  // namespace pcl_bv
