// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Separates people who stand so close together that they are one cluster.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcl_bv/points/point_view.h"
#include "plan_basins.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Cuts a group of upright objects into the single objects, at the necks between them. Seen from above, an
/// upright object is a peak of the density of points, and the density is low at the necks.
class NeckCut {
 public:
  /// Replaces `part_of` by the number of the part of each point. Returns the number of parts. With fewer than
  /// two parts, the cluster is not cut and `part_of` is undefined.
  ///
  /// A cluster is cut if at least two of its parts are upright objects, and these have most of its points.
  /// An upright object has the size of a person and at least `min_size` points, or 10 if that is more. Each
  /// remaining point belongs to the nearest upright object. The points are sparser far from `sensor`, so the
  /// density is measured in larger cells there. `up` has length 1. All points must be valid. O(n log n).
  std::size_t find(const PointView& cluster, const Eigen::Vector3d& up, const Eigen::Vector3d& sensor,
                   std::size_t min_size, std::vector<std::uint32_t>& part_of);

 private:
  struct Basin {
    Eigen::Vector3d low, high;  // two directions of the plane, then height
    std::size_t points = 0;
    std::uint32_t part = 0;
    bool upright = false;
  };

  bool project(const PointView& cluster, const Eigen::Vector3d& up);
  void measure_basins(std::size_t count);
  std::size_t number_parts(std::size_t min_size);

  PlanBasins plan_basins_;
  std::vector<Eigen::Vector2d> plan_;
  std::vector<double> heights_;
  std::vector<std::uint32_t> basin_of_;
  std::vector<Basin> basins_;
};

}  // namespace detail
}  // namespace pcl_bv
