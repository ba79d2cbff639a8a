// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Points with their numbers in the whole cloud.
#pragma once

#include <cstddef>
#include <vector>

#include "pcl_bv/points/point_view.h"

namespace pcl_bv::detail {

/// A point and its number in the whole cloud.
struct NumberedPoint {
  std::size_t number;
  Coordinates point;
};

inline bool operator<(const NumberedPoint& a, const NumberedPoint& b) {
  return a.number < b.number;
}

inline bool same_number(const NumberedPoint& a, const NumberedPoint& b) {
  return a.number == b.number;
}

/// Points in ascending order of their numbers.
using NumberedPoints = std::vector<NumberedPoint>;

/// Throws std::invalid_argument unless `disjoint`. The message says that a point is in two parts.
void require_disjoint(bool disjoint);

/// Returns the points of `a` and `b`. Throws as require_disjoint() does if a number is in both lists.
NumberedPoints merged(const NumberedPoints& a, const NumberedPoints& b);

/// Stores points without gaps as floats or doubles, for the kernels.
class PackedPoints {
 public:
  PackedPoints(const NumberedPoints& points, ScalarType scalar);
  PackedPoints(const PackedPoints&) = delete;
  PackedPoints& operator=(const PackedPoints&) = delete;

  const PointView& view() const { return view_; }

 private:
  std::vector<float> floats_;
  std::vector<double> doubles_;
  PointView view_;
};

}  // namespace pcl_bv::detail
