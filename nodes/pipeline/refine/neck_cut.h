// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Separates people who stand so close to each other, or to other objects, that they are one cluster.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"
#include "plan_basins.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Cuts people out of a cluster, at the necks between them and the rest. Seen from above, a person is a peak
/// of the density of points, and the density is low at the necks.
///
/// There are two kinds of cuts:
/// - A group: at least two parts have the size of a person, and these have 70 % of the points. Each other
///   point belongs to the nearest person.
/// - A person next to something else, such as a car or a wall: the part has the shape of a person, begins at
///   the lowest point of the cluster, and has enough points for its size. The other points stay one object.
class NeckCut {
 public:
  /// Replaces `part_of` by the number of the part of each point. Returns the number of parts. With fewer than
  /// two parts, the cluster is not cut and `part_of` is undefined.
  ///
  /// A person has at least `min_size` points, or 10 if that is more. The points are sparser far from
  /// `sensor`, so the density is measured in larger cells there. `up` has length 1. All points must be valid.
  /// O(n log n).
  std::size_t find(UsableIsa isa, const PointView& cluster, const Eigen::Vector3d& up,
                   const Eigen::Vector3d& sensor, std::size_t min_size, std::vector<std::uint32_t>& part_of);

 private:
  // Coordinates are along two directions of the plane, then up.
  struct Basin {
    Eigen::AlignedBox3d box;  // of the points above the floor
    double lowest = 0;        // height of the lowest point
    std::size_t points = 0;
    std::uint32_t part = 0;
    bool person = false;
    bool far_from_people = false;
  };
  // Squares of 1 m cover a cluster of 12 m, with a margin of one square on each side.
  static constexpr std::size_t kRow = 15;

  bool project(UsableIsa isa, const PointView& cluster, const Eigen::Vector3d& up);
  void find_low_points();
  void find_basins(double cell);
  bool give_low_points();
  std::uint32_t number_group(std::size_t min_size);
  std::uint32_t give_remainder(std::uint32_t parts, std::size_t min_size);
  std::uint32_t number_people(std::size_t min_size);
  bool stands_out(const Basin& basin) const;

  PlanBasins plan_basins_;
  std::vector<Eigen::Vector3d> points_;
  Eigen::AlignedBox3d box_;                             // of points_
  std::array<double, kRow * kRow> lowest_{}, floor_{};  // heights: of a square, and of it and those around it
  std::vector<std::uint32_t> tall_, low_;               // points above the floor, and the others
  std::vector<Eigen::Vector2d> plan_;                   // of the points in tall_
  std::vector<std::uint32_t> tall_basin_, basin_of_;
  std::vector<Basin> basins_;
};

}  // namespace detail
}  // namespace pcl_bv
