// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Collision checks between two point clouds, a cloud and volumes, or two lists of volumes. A pose moves the
// second argument of each check.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "pcl_bv/trees/point_tree.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Volumes that move together, such as the links of an arm in one posture, prepared for collision checks.
///
/// Preparing takes about 50 us per k-DOP or hull, and less per volume of another type. Volumes are identified
/// by their index in the list. Empty volumes touch nothing. Copies are cheap because they share the data.
class MovingVolumes {
 public:
  /// Prepares the volumes.
  explicit MovingVolumes(std::vector<AnyVolume> volumes);

  /// Returns the volumes passed to the constructor.
  const std::vector<AnyVolume>& volumes() const;

  // Internal. The prepared volumes.
  struct State;
  const State& state() const { return *state_; }

 private:
  std::shared_ptr<const State> state_;
};

/// Returns whether any point of one cloud is within `margin` of a point of the other cloud.
///
/// `pose` transforms `others` to the frame of `points`. The result is always true if a point of `points` is
/// within the margin of the exact value of `pose * p` for a point p of `others`. The result may also be true
/// for points that are farther apart than the margin by about 1e-15 of the coordinates. The result is false
/// if either tree has no points. All functions in this header throw std::invalid_argument unless the margin
/// is from 0 to 1e100 and the pose is finite.
bool within(const PointTree& points, const PointTree& others, const Eigen::Isometry3d& pose,
            double margin = 0);

/// Returns whether any point is within `margin` of a volume that `pose` has moved.
///
/// The distance of a point is distance() of the point from the moved ConvexBody. distance() never exceeds the
/// exact distance, so the result is always true if a point is within the margin. The result may also be true
/// for a point that is farther by the rounding error that pair_queries.h states.
bool within(const PointTree& points, const MovingVolumes& volumes, const Eigen::Isometry3d& pose,
            double margin = 0);

/// Replaces `indices` by the indices of the volumes that are within `margin` of any point, ascending.
void list_within(const PointTree& points, const MovingVolumes& volumes, const Eigen::Isometry3d& pose,
                 double margin, std::vector<std::int32_t>& indices);

/// Returns whether a volume of `volumes` is within `margin` of a volume of `others` that `pose` has moved.
/// The result for two volumes is that of within() of their ConvexBodies, so it is always true if the volumes
/// are within the margin.
bool within(const MovingVolumes& volumes, const MovingVolumes& others, const Eigen::Isometry3d& pose,
            double margin = 0);

/// Replaces `pairs` by all pairs of volumes within `margin` of each other, ascending. A pair is the index in
/// `volumes` and the index in `others`. `pose` moves `others`.
void list_within(const MovingVolumes& volumes, const MovingVolumes& others, const Eigen::Isometry3d& pose,
                 double margin, std::vector<std::pair<std::int32_t, std::int32_t>>& pairs);

}  // namespace pcl_bv
