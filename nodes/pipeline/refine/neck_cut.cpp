// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "neck_cut.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace pcl_bv::detail {
namespace {

// Sizes of an upright object, metres. A person with a bag or a pushchair is wider than 1.1 m.
constexpr double kMaxWidth = 1.1;
constexpr double kMinHeight = 0.9;
constexpr double kMaxHeight = 2.3;
constexpr double kMinSlenderness = 1.3;  // height divided by width

// A narrower cluster is one person with spread arms. A wider or higher one is no group of people.
constexpr double kMinGroupWidth = 0.9, kMaxGroupWidth = 12, kMaxGroupHeight = 2.6;
constexpr std::size_t kMinPoints = 10;  // fewer points have no density
// At most this share of the points of a group may be in other parts, such as arms and bags.
constexpr double kMaxRemainder = 0.3;

// Side of a cell: 7 cm, and 2 mm more for each metre of distance beyond 35 m. Spinning LiDARs have azimuth
// steps of 0.1 to 0.4 degrees, 1.7 to 7 mm per metre.
constexpr double kMinCell = 0.07, kCellPerMetre = 0.002;

}  // namespace

// Returns whether the cluster has the size of a group. If so, the plan has its origin at a corner of the
// cluster.
bool NeckCut::project(const PointView& cluster, const Eigen::Vector3d& up) {
  const Eigen::Vector3d x = up.unitOrthogonal(), y = up.cross(x);
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  plan_.clear();
  heights_.clear();
  for (std::size_t i = 0; i < cluster.count; ++i) {
    const Coordinates c = load_point(cluster, i);
    const Eigen::Vector3d point(c.x, c.y, c.z);
    plan_.emplace_back(point.dot(x), point.dot(y));
    heights_.push_back(point.dot(up));
    low = low.cwiseMin(plan_.back());
    high = high.cwiseMax(plan_.back());
  }
  const auto [lowest, highest] = std::minmax_element(heights_.begin(), heights_.end());
  const double width = (high - low).maxCoeff();
  if (!(width >= kMinGroupWidth && width <= kMaxGroupWidth && *highest - *lowest <= kMaxGroupHeight))
    return false;
  for (Eigen::Vector2d& point : plan_)
    point -= low;
  return true;
}

void NeckCut::measure_basins(std::size_t count) {
  const Eigen::Vector3d infinite = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  basins_.assign(count, {infinite, -infinite});
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    Basin& basin = basins_[basin_of_[i]];
    const Eigen::Vector3d point(plan_[i].x(), plan_[i].y(), heights_[i]);
    basin.low = basin.low.cwiseMin(point);
    basin.high = basin.high.cwiseMax(point);
    ++basin.points;
  }
}

std::size_t NeckCut::number_parts(std::size_t min_size) {
  std::uint32_t parts = 0;
  std::size_t upright_points = 0;
  for (Basin& basin : basins_) {
    const Eigen::Vector3d size = basin.high - basin.low;
    const double width = size.head<2>().maxCoeff(), height = size.z();
    basin.upright = basin.points >= min_size && width <= kMaxWidth && height >= kMinHeight &&
                    height <= kMaxHeight && height >= kMinSlenderness * width;
    if (!basin.upright) continue;
    basin.part = parts++;
    upright_points += basin.points;
  }
  const auto remainder = static_cast<double>(plan_.size() - upright_points);
  if (parts < 2 || remainder > kMaxRemainder * static_cast<double>(plan_.size())) return 1;
  for (Basin& other : basins_) {
    if (other.upright) continue;
    double least = std::numeric_limits<double>::infinity();
    for (const Basin& basin : basins_) {
      if (!basin.upright) continue;
      const double distance = (basin.low + basin.high - other.low - other.high).head<2>().norm();
      if (distance < least) other.part = basin.part;
      least = std::min(least, distance);
    }
  }
  return parts;
}

std::size_t NeckCut::find(const PointView& cluster, const Eigen::Vector3d& up, const Eigen::Vector3d& sensor,
                          std::size_t min_size, std::vector<std::uint32_t>& part_of) {
  min_size = std::max(min_size, kMinPoints);
  if (cluster.count < 2 * min_size || !project(cluster, up)) return 1;
  const Coordinates c = load_point(cluster, 0);
  const double distance = (Eigen::Vector3d(c.x, c.y, c.z) - sensor).norm();
  measure_basins(plan_basins_.find(plan_, std::max(kMinCell, kCellPerMetre * distance), basin_of_));
  const std::size_t parts = number_parts(min_size);
  part_of.resize(plan_.size());
  for (std::size_t i = 0; i < plan_.size(); ++i)
    part_of[i] = basins_[basin_of_[i]].part;
  return parts;
}

}  // namespace pcl_bv::detail
