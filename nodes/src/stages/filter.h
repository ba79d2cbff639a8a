// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The first look at a cloud: which points are kept.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "pcl_bv/kernels/point_view.h"
#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/segmentation/counts.h"

namespace pcl_bv {

/// A configured filter, for one point at a time.
class PointFilter {
 public:
  explicit PointFilter(const FilterConfig& config);

  struct Verdict {
    bool valid, inside;  ///< Whether the point counts, and whether it is in range and not of the own vehicle.
  };

  /// The square of a float is exact in double and the sum of three is rounded twice: a point is judged by its
  /// true distance to within 2e-16 of it.
  template <typename T>
  Verdict judge(const T (&p)[3]) const {
    const double x = p[0], y = p[1], z = p[2];
    const double distance2 = (x * x + y * y) + z * z;
    // The squares of finite floats are finite in double: one comparison instead of three.
    const bool valid =
        sizeof(T) == 4 ? distance2 < std::numeric_limits<double>::infinity() : is_valid({x, y, z});
    bool inside = distance2 >= min2_ && distance2 <= max2_;
    if (boxed_) {
      inside = inside && !(x >= low_.x() && x <= high_.x() && y >= low_.y() && y <= high_.y() &&
                           z >= low_.z() && z <= high_.z());
    }
    return {valid, inside};
  }

 private:
  double min2_, max2_;
  bool boxed_;
  Eigen::Vector3d low_, high_;  // of the own vehicle
};

/// Replaces `kept` with the numbers of the valid points in range and outside the own vehicle, in the order of
/// the view; counts the others.
void filter_points(const PointView& points, const FilterConfig& config, std::vector<std::int32_t>& kept,
                   Counts& counts);

}  // namespace pcl_bv
