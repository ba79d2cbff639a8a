// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A cloud far from its origin, as doubles near another one.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "pcl_bv/kernels/point_source.h"
#include "pcl_bv/parallel/policy.h"

namespace pcl_bv {

/// The points of a view less an origin: differences, rounded to double.
class ShiftedPoints final : public PointSource {
 public:
  /// Keeps the view, whose points are not of an index list.
  ShiftedPoints(const PointView& points, const Eigen::Vector3d& origin) : points_(points), origin_(origin) {}

  PointView view() const { return view_of(*this, points_.count, ScalarType::float64); }

  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override;

 private:
  PointView points_;
  Eigen::Vector3d origin_;
};

/// The middle of the points' box in whole numbers; 0 without a valid point.
Eigen::Vector3d whole_origin(const PointView& points, const ParallelPolicy& policy);

/// All points of a source, three doubles each.
std::vector<double> load_all(const PointView& points);

}  // namespace pcl_bv
