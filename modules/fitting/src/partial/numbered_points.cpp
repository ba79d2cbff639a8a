// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "partial/numbered_points.h"

#include <algorithm>
#include <stdexcept>

namespace pcl_bv::detail {
namespace {

template <typename T>
PointView view_of(const NumberedPoints& points, std::vector<T>& packed) {
  packed.reserve(3 * points.size());
  for (const NumberedPoint& p : points) {
    for (std::size_t k = 0; k < 3; ++k)
      packed.push_back(static_cast<T>(p.point[k]));
  }
  return PointView::of(packed.data(), 3 * sizeof(T), points.size());
}

}  // namespace

void require_disjoint(bool disjoint) {
  if (!disjoint) throw std::invalid_argument("Partial: a point is in two parts");
}

NumberedPoints merged(const NumberedPoints& a, const NumberedPoints& b) {
  NumberedPoints both(a.size() + b.size());
  std::merge(a.begin(), a.end(), b.begin(), b.end(), both.begin());
  require_disjoint(std::adjacent_find(both.begin(), both.end(), same_number) == both.end());
  return both;
}

PackedPoints::PackedPoints(const NumberedPoints& points, ScalarType scalar)
    : view_(scalar == ScalarType::float32 ? view_of(points, floats_) : view_of(points, doubles_)) {}

}  // namespace pcl_bv::detail
