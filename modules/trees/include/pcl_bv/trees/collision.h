// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Do clouds touch, does a robot touch a cloud: questions to two trees, one of which has moved.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "pcl_bv/trees/point_tree.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Volumes that move together, as the links of an arm in one posture do, made ready to be asked where they
/// are then: some 50 us for each k-DOP and hull, less for others. Named by their numbers in the list; empty
/// ones touch nothing. Cheap to copy.
class MovingVolumes {
 public:
  explicit MovingVolumes(std::vector<AnyVolume> volumes);

  const std::vector<AnyVolume>& volumes() const;

  struct State;
  const State& state() const { return *state_; }

 private:
  std::shared_ptr<const State> state_;
};

/// Whether a point of one cloud is within `margin` of a point of the other, which `pose` leads to the frame
/// of the first: of p and the image of q by exact arithmetic on the stored matrix. Never false for two that
/// are; errs only towards true, by some 1e-15 of the coordinates. False if either has no points. All of these
/// throw std::invalid_argument for a margin that is not from 0 to 1e100 and for a pose that is not finite.
bool within(const PointTree& points, const PointTree& others, const Eigen::Isometry3d& pose,
            double margin = 0);

/// Whether a point is within `margin` of a volume. Likewise never false for two that are. Where a point is
/// near, distance() of the volume's ConvexBody, moved, decides, and errs towards true as pairs.h says.
bool within(const PointTree& points, const MovingVolumes& volumes, const Eigen::Isometry3d& pose,
            double margin = 0);

/// The numbers of the volumes for which that is so, ascending: replaces what is in `touched`.
void list_within(const PointTree& points, const MovingVolumes& volumes, const Eigen::Isometry3d& pose,
                 double margin, std::vector<std::int32_t>& touched);

/// Whether two volumes, of which those of `others` have moved, are within `margin`: within() of their
/// ConvexBodies, which is never false for two that are.
bool within(const MovingVolumes& volumes, const MovingVolumes& others, const Eigen::Isometry3d& pose,
            double margin = 0);

/// The numbers of all such pairs, ascending.
void list_within(const MovingVolumes& volumes, const MovingVolumes& others, const Eigen::Isometry3d& pose,
                 double margin, std::vector<std::pair<std::int32_t, std::int32_t>>& pairs);

}  // namespace pcl_bv
