// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Distances of points and boxes from a volume.
#pragma once

#include "box_relation.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/volumes/pair_queries.h"

namespace pcl_bv::detail {

/// Distances from a non-empty volume.
class BodyDistance {
 public:
  explicit BodyDistance(const AnyVolume& volume) : body_(volume) {
    const Aabb box = aabb(volume);
    size_ = taxicab3(box.min()) + taxicab3(box.max());
  }

  double distance_to(const Eigen::Vector3d& point) const { return distance(body_, point); }

  /// Returns a lower bound of distance_to(p) for all points p in the box. Returns NaN for an empty box. The
  /// bound holds because the distances of two points from the volume differ by at most the distance between
  /// the points. The margin of 2^-36 is needed because distance() may be below the exact distance by 1e-12 of
  /// the distance and of the sizes.
  double lower_bound(const PlainBox& box) const {
    const Eigen::Vector3d middle = 0.5 * (box.low + box.high);
    const double radius = 0.5 * (box.high - box.low).stableNorm(), away = distance_to(middle);
    return away - radius - 0x1p-36 * (away + radius + size_ + taxicab3(middle));
  }

 private:
  ConvexBody body_;
  double size_;
};

}  // namespace pcl_bv::detail
