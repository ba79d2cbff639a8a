// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoints.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "occlusion.h"
#include "pipeline/refine/geometry.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kSectorSamples = 4096;  // of each sensor: 64 a sector, if it measures all around

// Returns the number of the sector of a direction, 0 to 63. The sectors have 4.6 to 7.2 degrees, because the
// number comes from a quotient instead of the angle.
unsigned sector_of(double x, double y) {
  const double sum = std::abs(x) + std::abs(y);
  if (!(sum > 0)) return 0;
  const double quotient = y / sum, turn = x < 0 ? 2 - quotient : y < 0 ? 4 + quotient : quotient;
  return std::min(63U, static_cast<unsigned>(16 * turn));
}

// Returns the sectors in which points of the view from `begin` to `end` are.
std::uint64_t sectors_with_points(const PointView& points, std::size_t begin, std::size_t end,
                                  const Eigen::Vector3d& from) {
  if (points.source != nullptr) return ~std::uint64_t{0};
  std::uint64_t sectors = 0;
  // The step is odd, so that it has no common period with the beams of a sensor.
  const std::size_t step = (end - begin) / kSectorSamples | 1U;
  for (std::size_t i = begin; i < end; i += step) {
    const Coordinates point = load_point(points, i);
    if (is_valid(point)) sectors |= std::uint64_t{1} << sector_of(point.x - from.x(), point.y - from.y());
  }
  return sectors;
}

// Returns the position in the view of the first point whose number in the cloud is at least `number`.
std::size_t position_of(const PointView& points, std::size_t number) {
  if (points.indices == nullptr)
    return std::clamp(number, points.first, points.first + points.count) - points.first;
  const std::int32_t* const end = points.indices + points.count;
  const auto below = [&](std::int32_t index) { return static_cast<std::size_t>(index) < number; };
  return static_cast<std::size_t>(std::partition_point(points.indices, end, below) - points.indices);
}

}  // namespace

const Viewpoints& Viewpoints::single() {
  static const Viewpoints origin;
  return origin;
}

void Viewpoints::find(const std::vector<SensorPart>& sensors, const PointView& points,
                      const Eigen::Vector3d& otherwise) {
  viewpoints_.clear();
  for (const SensorPart& sensor : sensors) {
    if (sensor.count == 0) continue;
    const std::size_t begin = position_of(points, sensor.first),
                      end = position_of(points, sensor.first + sensor.count);
    viewpoints_.push_back({sensor.position, sectors_with_points(points, begin, end, sensor.position)});
  }
  if (viewpoints_.empty()) viewpoints_.push_back({otherwise});
}

bool Viewpoints::occluded(const Eigen::Vector3d& position, const std::vector<Aabb>& boxes,
                          std::size_t own) const {
  return std::all_of(viewpoints_.begin(), viewpoints_.end(), [&](const Viewpoint& from) {
    const Eigen::Vector3d ray = position - from.position;
    const bool measured = (from.sectors >> sector_of(ray.x(), ray.y()) & 1U) != 0;
    if (!measured) return true;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (i != own && occludes(boxes[i], position, from.position)) return true;
    return false;
  });
}

VisibleFace Viewpoints::visible_face(const Eigen::Vector3d& axis, const Eigen::Vector3d& origin, double low,
                                     double high) const {
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const Viewpoint& viewpoint : viewpoints_) {
    const double at = axis.dot(viewpoint.position - origin);
    first = std::min(first, at);
    last = std::max(last, at);
  }
  if (last < low) return VisibleFace::low;
  return first > high ? VisibleFace::high : VisibleFace::both;
}

Eigen::Vector3d nearest_sensor(const std::vector<SensorPart>& sensors, const Eigen::Vector3d& point,
                               const Eigen::Vector3d& otherwise) {
  Eigen::Vector3d nearest = otherwise;
  double least = std::numeric_limits<double>::infinity();
  for (const SensorPart& sensor : sensors) {
    const double distance = (sensor.position - point).squaredNorm();
    if (sensor.count == 0 || distance >= least) continue;
    least = distance;
    nearest = sensor.position;
  }
  return nearest;
}

}  // namespace pcl_bv::detail
