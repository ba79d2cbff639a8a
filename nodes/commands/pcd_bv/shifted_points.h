// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "pcl_bv/parallel/policy.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv {

/// The points of a view, which are not of an index list, less an origin: differences, rounded to double.
class ShiftedPoints final : public PointSource {
 public:
  ShiftedPoints(const PointView& points, const Eigen::Vector3d& origin) : points_(points), origin_(origin) {}

  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override;

 private:
  PointView points_;
  Eigen::Vector3d origin_;
};

/// The middle of the points' box in whole numbers; 0 without a valid point.
Eigen::Vector3d whole_origin(const PointView& points, const ParallelPolicy& policy);

/// All points of a view, one after another in its type.
std::vector<std::byte> packed_copy(const PointView& points);

}  // namespace pcl_bv
