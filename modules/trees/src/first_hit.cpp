// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "box_walk.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/trees/point_tree.h"
#include "refusal.h"
#include "vectors.h"

namespace pcl_bv {
namespace {

// A ray that is not finite meets nothing, and so do boxes and points beyond 2^60 times the cloud's size:
// there floats tell nothing, so all is asked.
constexpr double kFar = 0x1p60;

// A moving sphere in the frame of the boxes, with the direction's longest coordinate from 1 to 2. All boxes
// are greater by its radius and by `pad`, a thousand times what rounding to float moves a place along the
// ray.
struct RayProbe {
  float origin[3], inverse[3];
  float pad;
  double time;  // times in this frame of those asked about

  RayProbe(const BoxLevels& boxes, const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
           double radius) {
    const int exponent = std::ilogb(direction.cwiseAbs().maxCoeff());
    time = std::ldexp(boxes.scale, exponent);
    double size = 1 + radius * boxes.scale;
    for (int k = 0; k < 3; ++k) {
      const double place = (from[k] - boxes.origin[static_cast<std::size_t>(k)]) * boxes.scale;
      size += std::abs(place);
      origin[k] = static_cast<float>(std::clamp(place, -kFar, kFar));
      // A slope below 2^-40 is taken for that: it moves a place by no more than pad.
      const double slope = std::ldexp(direction[k], -exponent);
      inverse[k] = static_cast<float>(1 / (slope < 0 ? std::min(slope, -0x1p-40) : std::max(slope, 0x1p-40)));
    }
    pad = static_cast<float>(radius * boxes.scale + 0x1p-16 * size);
    if (size < kFar && std::isfinite(time) && time > 0x1p-960) return;
    pad = std::numeric_limits<float>::infinity();  // every box is entered at 0
    time = 1;
  }
};

// When the ray enters each box of a group, and infinity where it does not.
std::array<float, kTreeWidth> enter_times(const BoxGroup& group, const RayProbe& ray) {
  std::array<float, kTreeWidth> enter{}, leave;
  leave.fill(std::numeric_limits<float>::infinity());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float* const low = ray.inverse[axis] > 0 ? group.low[axis] : group.high[axis];
    const float* const high = ray.inverse[axis] > 0 ? group.high[axis] : group.low[axis];
    const float pad = ray.inverse[axis] > 0 ? ray.pad : -ray.pad;
    for (std::size_t k = 0; k < kTreeWidth; ++k) {
      enter[k] = std::max(enter[k], (low[k] - pad - ray.origin[axis]) * ray.inverse[axis]);
      leave[k] = std::min(leave[k], (high[k] + pad - ray.origin[axis]) * ray.inverse[axis]);
    }
  }
  for (std::size_t k = 0; k < kTreeWidth; ++k)
    enter[k] = enter[k] <= leave[k] ? enter[k] : std::numeric_limits<float>::infinity();
  return enter;
}

class FirstHit {
 public:
  FirstHit(const PackedTree& tree, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
           double radius)
      : tree_(tree),
        origin_(origin),
        direction_(direction),
        unit_(direction.stableNormalized()),
        radius_(radius),
        ray_(tree.boxes, origin, direction, radius) {}

  std::optional<PointHit> run() {
    descend(
        tree_.boxes, [&](std::size_t group) { return enter_times(tree_.boxes.groups[group], ray_); },
        [&] { return latest_; }, [&](std::size_t packet) { ask_packet(packet); });
    return best_.index < 0 ? std::nullopt : std::optional(best_);
  }

 private:
  void ask_packet(std::size_t packet) {
    const std::size_t first = packet * kTreeWidth;
    const auto ask = [&](const auto& points) {
      std::array<bool, kTreeWidth> near = near_line(points);
      for (std::size_t k = 0; k < kTreeWidth; ++k) {
        if (near[k])
          ask_point({*points.at(0, k), *points.at(1, k), *points.at(2, k)}, tree_.numbers[first + k]);
      }
    };
    if (tree_.scalar == ScalarType::float32) {
      ask(tree_.floats[packet]);
    } else {
      ask(tree_.doubles[packet]);
    }
    if (best_.index >= 0) latest_ = static_cast<float>(best_.t * ray_.time * (1 + 0x1p-16)) + ray_.pad;
  }

  // Which points the whole line may come near; a NaN is near nothing. With q from the origin to the point, |q
  // x d| is off by less than 2^-48 |q|_1 |d|, and what intersect() adds to a radius is less, too.
  template <typename T>
  std::array<bool, kTreeWidth> near_line(const PointPacket<T>& points) const {
    std::array<bool, kTreeWidth> near;
    for (std::size_t k = 0; k < kTreeWidth; ++k) {
      const double x = *points.at(0, k) - origin_.x(), y = *points.at(1, k) - origin_.y(),
                   z = *points.at(2, k) - origin_.z();
      const double u = y * unit_.z() - z * unit_.y(), v = z * unit_.x() - x * unit_.z(),
                   w = x * unit_.y() - y * unit_.x();
      const double far = radius_ + 0x1p-40 * ((std::abs(x) + std::abs(y)) + std::abs(z)) + 0x1p-400;
      near[k] = (u * u + v * v) + w * w <= far * far;
    }
    return near;
  }

  void ask_point(const Eigen::Vector3d& place, std::int32_t number) {
    const auto inside = Sphere(place, radius_).intersect(origin_, direction_);
    if (!inside) return;
    const PointHit hit{number, inside->enter};
    if (best_.index < 0 || hit.t < best_.t || (hit.t == best_.t && hit.index < best_.index)) best_ = hit;
  }

  const PackedTree& tree_;
  Eigen::Vector3d origin_, direction_, unit_;
  double radius_;
  RayProbe ray_;
  PointHit best_{-1, 0};
  float latest_ = std::numeric_limits<float>::infinity();
};

// Of a sphere that does not move.
std::optional<PointHit> lowest_inside(UsableIsa isa, const PackedTree& tree, const Sphere& sphere) {
  std::vector<Neighbor> found;
  list_in_ball(isa, tree, coordinates(sphere.center()), sphere.contained_square(), found);
  if (found.empty()) return std::nullopt;
  const auto lower = [](const Neighbor& a, const Neighbor& b) { return a.index < b.index; };
  return PointHit{std::min_element(found.begin(), found.end(), lower)->index, 0};
}

}  // namespace

std::optional<PointHit> PointTree::first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                             double radius) const {
  const FloatEnvironment environment;
  if (!(radius >= 0 && radius <= kMaxCoordinate))
    refuse("PointTree: the radius of a moving sphere must be from 0 to 1e100", radius);
  if (empty() || !origin.allFinite() || !direction.allFinite()) return std::nullopt;
  if (direction.isZero(0)) return lowest_inside(isa_, tree_, Sphere(origin, radius));
  return FirstHit(tree_, origin, direction, radius).run();
}

}  // namespace pcl_bv
