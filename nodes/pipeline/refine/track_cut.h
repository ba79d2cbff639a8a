// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Separates tracked people from what they stand next to.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pipeline/track/known_object.h"
#include "plan_basins.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Cuts the people that the tracker expects inside a cluster off this cluster.
///
/// Only people are cut off who were seen as a cluster of their own before. The cut is at the necks between
/// basins of the density seen from above (PlanBasins). Otherwise a track that began on a part of a car would
/// cut this part off again and again.
class TrackCut {
 public:
  /// Replaces `part_of` by the number of the part of each point. Returns the number of parts. With fewer than
  /// two parts, the cluster is not cut and `part_of` is undefined. `points` and their box `box` are in the
  /// fixed frame, whose z is up. `known` is sorted by the x of the centres. `cell` is the side of a cell of
  /// the density. The last part may be the rest of the cluster. Each part has at least `min_size` points, or
  /// 10 if that is more. O(n log n + n * people).
  ///
  /// Returns 1 if expects() is false. Callers test expects() first, because it needs only the box. Call
  /// reserve() for every cluster: which clusters hold an expected person depends on the tracks, so a later
  /// frame with the same clusters may need more memory.
  std::size_t find(const std::vector<Eigen::Vector3d>& points, const Eigen::AlignedBox3d& box,
                   const std::vector<KnownObject>& known, double cell, std::size_t min_size,
                   std::vector<std::uint32_t>& part_of);

  /// Returns whether the cluster may hold an expected person and something else. Also stores these people.
  bool expects(const Eigen::AlignedBox3d& box, const std::vector<KnownObject>& known);

  /// Allocates the memory for a cluster of `points` points.
  void reserve(std::size_t points, const Eigen::AlignedBox3d& box, double cell);

 private:
  struct Person {
    const KnownObject* expected = nullptr;
    std::size_t points = 0;
    Eigen::AlignedBox3d box;  // of these points
    std::uint32_t part = 0;
    bool found = false;
  };
  struct Basin {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    std::size_t points = 0;
    Eigen::AlignedBox3d box;
    Person* person = nullptr;
  };

  void find_near(const std::vector<Eigen::Vector3d>& points);
  void fill_basins(const std::vector<Eigen::Vector3d>& points, std::size_t count);
  void give_basins();
  std::uint32_t number_people(std::size_t min_size);
  void give_rest(const std::vector<Eigen::Vector3d>& points, std::vector<std::uint32_t>& part_of) const;

  PlanBasins plan_basins_;
  std::vector<Person> people_;
  std::vector<std::size_t> near_;  // points near people
  std::vector<Eigen::Vector2d> plan_;
  std::vector<std::uint32_t> basin_of_;
  std::vector<Basin> basins_;
};

}  // namespace detail
}  // namespace pcl_bv
