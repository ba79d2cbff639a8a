// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "neck_cut.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry.h"

namespace pcl_bv::detail {
namespace {

// Sizes of a person in a group, metres. A person with a bag or a pushchair is wider than 1.1 m. A single
// column of points is narrower than 0.25 m: the columns of a coarse sensor are further apart than a cell.
constexpr double kMinWidth = 0.25, kMaxWidth = 1.1;
constexpr double kMinHeight = 0.9;
constexpr double kMaxHeight = 2.3;
constexpr double kMinSlenderness = 1.3;  // height divided by width

// Limits for a person next to something else. Parts of cars and walls that have the size of a person are
// mostly wider, lower, or have fewer points for their size.
constexpr double kMaxWidthAlone = 0.85, kMinHeightAlone = 1.2;  // m
constexpr double kMaxRise = 0.2;     // m; the part begins this far above the lowest point at most
constexpr double kMinDensity = 0.5;  // of the part's points per width and height, divided by the rest's

// A narrower cluster is one person with spread arms. A wider or higher one is a building or a row of trees.
constexpr double kMinClusterWidth = 0.9, kMaxClusterWidth = 12, kMaxClusterHeight = 3;
constexpr std::size_t kMinPoints = 10;  // fewer points have no density
// At most this share of the points of a group may be in other parts, such as arms and bags.
constexpr double kMaxRemainder = 0.3;
// Other parts whose box centre is farther from those of all people, such as grass and kerbs, are no part of a
// person.
constexpr double kMaxPersonDistance = 0.8;  // m

// Points less than kLow above the lowest point of the squares around are grass, kerbs and feet: they join
// objects that are apart above them. They belong to the basin within kNear, if any.
constexpr double kSquare = 1, kLow = 0.3, kNear = 0.3;  // m

double distance_to(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& point) {
  return (point - point.cwiseMax(box.min()).cwiseMin(box.max())).head<2>().norm();
}

}  // namespace

// Returns whether the cluster may hold people and something else. If so, the origin is at a corner of the
// cluster. The box alone rejects most clusters; it is much faster than projecting single points.
bool NeckCut::project(UsableIsa isa, const PointView& cluster, const Eigen::Vector3d& up) {
  Eigen::Matrix3d axes;
  axes.row(0) = up.unitOrthogonal();
  axes.row(1) = up.cross(axes.row(0).transpose());
  axes.row(2) = up;
  const Eigen::AlignedBox3d box = box_along(isa, cluster, axes);
  const double width = plan_width(box), height = box.sizes().z();
  if (!(width >= kMinClusterWidth && width <= kMaxClusterWidth)) return false;
  if (!(height >= kMinHeight && height <= kMaxClusterHeight)) return false;
  const Eigen::Vector3d origin = point_at(cluster, 0);
  points_.clear();
  for (std::size_t i = 0; i < cluster.count; ++i) {
    const Eigen::Vector3d at = axes * (point_at(cluster, i) - origin) - box.min();
    points_.push_back(at.cwiseMax(0.0));  // rounding can be below the corner
  }
  box_ = {Eigen::Vector3d::Zero(), box.sizes()};
  return true;
}

void NeckCut::find_low_points() {
  lowest_.fill(std::numeric_limits<double>::infinity());
  const auto square_of = [](const Eigen::Vector3d& point) {
    return (static_cast<std::size_t>(point.x() / kSquare) + 1) * kRow +
           static_cast<std::size_t>(point.y() / kSquare) + 1;
  };
  for (const Eigen::Vector3d& point : points_) {
    double& lowest = lowest_[square_of(point)];
    lowest = std::min(lowest, point.z());
  }
  for (std::size_t x = 1; x + 1 < kRow; ++x) {
    for (std::size_t y = 1; y + 1 < kRow; ++y) {
      double& floor = floor_[x * kRow + y];
      floor = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < 9; ++i)
        floor = std::min(floor, lowest_[(x + i / 3 - 1) * kRow + y + i % 3 - 1]);
    }
  }
  tall_.clear();
  low_.clear();
  for (std::uint32_t i = 0; i < points_.size(); ++i)
    (points_[i].z() >= floor_[square_of(points_[i])] + kLow ? tall_ : low_).push_back(i);
}

void NeckCut::find_basins(double cell) {
  plan_.clear();
  for (const std::uint32_t i : tall_)
    plan_.emplace_back(points_[i].head<2>());
  const std::size_t count = plan_basins_.find(plan_, cell, tall_basin_);
  basins_.assign(count + 1, Basin());  // the last one is for low points that are near no other basin
  basin_of_.assign(points_.size(), static_cast<std::uint32_t>(count));
  for (std::size_t t = 0; t < tall_.size(); ++t) {
    Basin& basin = basins_[tall_basin_[t]];
    basin_of_[tall_[t]] = tall_basin_[t];
    basin.box.extend(points_[tall_[t]]);
    basin.lowest = basin.box.min().z();
    ++basin.points;
  }
}

// Gives each low point to the nearest basin within reach. Returns false, without doing this, if no basin is
// as narrow as a person.
bool NeckCut::give_low_points() {
  if (std::none_of(basins_.begin(), basins_.end() - 1,
                   [](const Basin& basin) { return plan_width(basin.box) <= kMaxWidth; }))
    return false;
  for (const std::uint32_t i : low_) {
    double least = kNear;
    for (std::uint32_t b = 0; b + 1 < basins_.size(); ++b) {
      const double distance = distance_to(basins_[b].box, points_[i]);
      if (distance >= least) continue;
      least = distance;
      basin_of_[i] = b;
    }
    Basin& basin = basins_[basin_of_[i]];
    basin.lowest = std::min(basin.lowest, points_[i].z());
    ++basin.points;
  }
  return true;
}

// Numbers the parts of a group. Returns 0 if the cluster is no group.
std::uint32_t NeckCut::number_group(std::size_t min_size) {
  std::uint32_t parts = 0;
  std::size_t rest = points_.size();
  for (Basin& basin : basins_) {
    const double width = plan_width(basin.box), height = basin.box.max().z() - basin.lowest;
    basin.person = basin.points >= min_size && width >= kMinWidth && width <= kMaxWidth &&
                   height >= kMinHeight && height <= kMaxHeight && height >= kMinSlenderness * width;
    if (!basin.person) continue;
    basin.part = parts++;
    rest -= basin.points;
  }
  if (parts < 2 || static_cast<double>(rest) > kMaxRemainder * static_cast<double>(points_.size())) return 0;
  return parts + give_remainder(parts, min_size);
}

// Gives each of the other basins to the nearest person. If those too far away are large enough together, they
// become part number `parts`. Returns the number of parts that were added.
std::uint32_t NeckCut::give_remainder(std::uint32_t parts, std::size_t min_size) {
  std::size_t far_points = 0;
  for (Basin& other : basins_) {
    if (other.person || other.points == 0) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Basin& basin : basins_) {
      const double distance = (basin.box.center() - other.box.center()).head<2>().norm();
      if (!basin.person || distance >= nearest) continue;
      nearest = distance;
      other.part = basin.part;
    }
    other.far_from_people = other.box.isEmpty() || nearest > kMaxPersonDistance;
    if (other.far_from_people) far_points += other.points;
  }
  if (far_points < min_size) return 0;
  for (Basin& other : basins_)
    if (other.far_from_people) other.part = parts;
  return 1;
}

// Whether a basin with the size of a person is a person next to something else.
bool NeckCut::stands_out(const Basin& basin) const {
  const double width = plan_width(basin.box), height = basin.box.max().z() - basin.lowest;
  if (!basin.person || width > kMaxWidthAlone || height < kMinHeightAlone) return false;
  if (basin.lowest > kMaxRise) return false;
  const auto points = static_cast<double>(basin.points), rest = static_cast<double>(points_.size()) - points;
  return points * plan_width(box_) * box_.sizes().z() >= kMinDensity * rest * std::max(0.2, width) * height;
}

// Numbers the people next to something else, and after them the rest. Returns the number of parts.
std::uint32_t NeckCut::number_people(std::size_t min_size) {
  std::uint32_t parts = 0;
  std::size_t rest = points_.size();
  for (Basin& basin : basins_) {
    basin.person = stands_out(basin);
    if (!basin.person) continue;
    basin.part = parts++;
    rest -= basin.points;
  }
  if (parts == 0 || rest < min_size) return 1;
  for (Basin& basin : basins_)
    if (!basin.person) basin.part = parts;
  return parts + 1;
}

std::size_t NeckCut::find(UsableIsa isa, const PointView& cluster, const Eigen::Vector3d& up,
                          const Eigen::Vector3d& sensor, std::size_t min_size,
                          std::vector<std::uint32_t>& part_of) {
  min_size = std::max(min_size, kMinPoints);
  if (cluster.count < 2 * min_size || !project(isa, cluster, up)) return 1;
  find_low_points();
  find_basins(density_cell((point_at(cluster, 0) - sensor).norm()));
  if (!give_low_points()) return 1;
  std::uint32_t parts = number_group(min_size);
  if (parts == 0) parts = number_people(min_size);
  part_of.resize(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i)
    part_of[i] = basins_[basin_of_[i]].part;
  return parts;
}

}  // namespace pcl_bv::detail
