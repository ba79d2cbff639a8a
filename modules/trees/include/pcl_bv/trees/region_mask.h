// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Which points of a cloud are inside volumes: a robot's own links, which its sensors see, or a region to
// crop.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/kernels/region_states.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

class VolumeBoxes;

/// A volume, grown by `padding` (in the points' unit, 0 to 1e100) in every direction. Empty ones stay empty.
///
/// It keeps its kind, and holds every point within `padding` of a point of the volume, by exact arithmetic:
/// - Sphere, Capsule: the radius grows. Nothing else is inside.
/// - Aabb, Obb: the half extents grow; so the corners stay sharp. Cylinder: radius and half height.
/// - Kdop, Hull: each plane moves outward. A corner reaches farther the sharper it is: between two planes at
///   an angle a, by padding / sin(a / 2).
/// - Ellipsoid: radius r becomes sqrt(r^2 + padding^2 + padding (r^2 / m + m)) for an m between the least and
///   the greatest of the three, that which makes the volume nearly least (Kurzhanski, Valyi 1997). Radii
///   greater by the padding would not hold all of that; equal ones do become so.
/// Each number is rounded up.
struct Region {
  AnyVolume volume;
  double padding = 0;
};

/// The union of some regions. Const calls may run side by side; copies are independent.
class RegionMask {
 public:
  /// No regions: nothing is inside. Throws std::invalid_argument, naming value and range, for a padding that
  /// is not from 0 to 1e100.
  explicit RegionMask(const std::vector<Region>& regions);

  /// Whether contains() of one of the grown volumes holds: with padding 0, of the volumes themselves. So it
  /// errs only towards true, and by no more than they say. False for a point that is_valid() does not count.
  bool contains(const Eigen::Vector3d& point) const;

  /// Sets inside[i] to 1 where contains() holds for the i-th visited point, else to 0, and its size to
  /// points.count; a NaN or an infinity is inside nothing. The same for every Execution, whose supports are
  /// not asked. Throws what a PointSource throws. Up to kFewRegions every point is tested against all of
  /// them, where those whose boxes are elsewhere cost little, and nothing is allocated but what `inside`
  /// lacks. More of them are in a tree, which runs of points are looked up in.
  void mark(const PointView& points, std::vector<std::uint8_t>& inside,
            const Execution& execution = {}) const;

  /// Regions from which on a tree is faster.
  static constexpr std::size_t kFewRegions = 12;

 private:
  void mark_chunk(const PointView& points, std::uint8_t* marks, const Execution& execution) const;

  std::vector<AnyVolume> volumes_;  // grown
  RegionTests tests_;
  std::shared_ptr<const VolumeBoxes> boxes_;  // null if there are few
};

}  // namespace pcl_bv
