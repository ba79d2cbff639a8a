// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the points of a cloud that are inside given volumes, e.g. a robot's own links or a region to crop.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A volume inflated by `padding` in every direction. The padding is in the unit of the points, 0 to 1e100.
///
/// The inflated volume has the same type. It contains every point within `padding` of the volume. Rounding
/// excludes no such point, because the inflated sizes are rounded up. An empty volume stays empty.
/// - Sphere and Capsule: the radius grows by the padding. Except for rounding, no point of the inflated
///   volume is farther from the volume than the padding.
/// - Aabb and Obb: the half extents grow by the padding, so corners stay sharp.
/// - Cylinder: the radius and the half height grow by the padding.
/// - Kdop and Hull: each plane moves outward by the padding. The edge between two planes at an interior angle
///   a moves by padding / sin(a / 2), so sharp edges move farther.
/// - Ellipsoid: a radius r becomes sqrt(r^2 + padding^2 + padding (r^2 / m + m)). The number m between the
///   smallest and the largest radius is chosen so that the volume is nearly minimal (Kurzhanski, Valyi 1997).
///   Equal radii become r + padding; unequal radii have to grow by more.
/// - Prism: the heights move by the padding. The outline grows by a regular polygon of 16 sides around a
///   circle with this radius. So no point of the inflated prism is farther above, below or beside the prism
///   than 1.02 times the padding. An outline that is not convex is replaced by its convex hull first, unless
///   the padding is 0.
struct Region {
  /// The volume before inflation.
  AnyVolume volume;
  /// Distance by which the volume is inflated.
  double padding = 0;
};

/// Tests points against the union of inflated volumes.
///
/// Const member functions may be called from several threads at the same time. Copies are independent.
class RegionMask {
 public:
  /// Inflates the volumes. Without regions nothing is inside. Throws std::invalid_argument, with the value
  /// and the range, for a padding outside 0 to 1e100.
  explicit RegionMask(const std::vector<Region>& regions);

  /// Returns whether contains() holds for any of the inflated volumes. With padding 0 these are the volumes
  /// themselves. An outside point may be treated as inside if its distance from the surface is below the
  /// rounding error, as contains() of each type documents. Returns false if is_valid() does not hold for the
  /// point.
  bool contains(const Eigen::Vector3d& point) const;

  /// Resizes `inside` to points.count. Sets inside[i] to 1 if contains() holds for the i-th visited point,
  /// else to 0. Points with a NaN or an infinity get 0.
  ///
  /// The result is the same for every Execution. Exceptions of a PointSource pass through. With at most
  /// kFewRegions regions, each point is tested against all regions, and only `inside` is allocated. Regions
  /// whose boxes are far from the points cost little. With more regions, the regions near each run of
  /// consecutive points are looked up in a tree if this is cheaper.
  void mark(const PointView& points, std::vector<std::uint8_t>& inside,
            const Execution& execution = {}) const;

  /// Returns a box around each inflated volume that is not empty, in the order of the regions. contains()
  /// holds for no point outside all boxes. The box of a sharp Hull or Kdop may be much larger than that of
  /// the volume before inflation. Sides that no plane limits are the largest finite number.
  std::vector<Aabb> extents() const;

  /// Largest number of regions that are tested without a tree.
  static constexpr std::size_t kFewRegions = 12;

 private:
  struct State;

  std::shared_ptr<const State> state_;
};

}  // namespace pcl_bv
