// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The points that pass a rounded filter: nearly none, so the loop over the others is what counts.
#pragma once

#include <cstddef>
#include <cstring>

#include "pcl_bv/kernels/point_view.h"
#include "pcl_bv/numeric/exact_dot.h"

namespace pcl_bv {

/// Which points are worth an exact look: those whose rounded projection, relative to `center` and in the
/// view's scalar type, is at least `threshold` (a value of that type).
struct RoundedFilter {
  Coordinates center;
  double threshold;
};

/// RoundedFilter along a direction, in registers.
template <typename T>
struct FilterOf {
  FilterOf(const Direction& direction, const RoundedFilter& filter)
      : a(static_cast<T>(direction[0])),
        b(static_cast<T>(direction[1])),
        c(static_cast<T>(direction[2])),
        x(static_cast<T>(filter.center.x)),
        y(static_cast<T>(filter.center.y)),
        z(static_cast<T>(filter.center.z)),
        threshold(static_cast<T>(filter.threshold)) {}

  bool rejects(const T (&p)[3]) const {
    return (a * (p[0] - x) + b * (p[1] - y)) + c * (p[2] - z) < threshold;  // an overflown sum may be NaN
  }

  T a, b, c, x, y, z, threshold;
};

// `address` gives where a point's x is, `gap` the bytes from there to y and on to z.
template <typename T, typename Address, typename Consider>
void for_each_passing(const PointView& points, Address address, std::size_t gap, std::size_t first,
                      std::size_t step, std::size_t end, const FilterOf<T>& filter,
                      const Consider& consider) {
  const auto load = [&](std::size_t i, T(&p)[3]) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      std::memcpy(&p[axis], address(i) + axis * gap, sizeof(T));
  };
  T p[3];
  for (std::size_t i = first; i < end; i += step) {
    // A loop of its own: the calls below would keep the filter out of registers.
    for (load(i, p); filter.rejects(p); load(i, p)) {
      i += step;
      if (i >= end) return;
    }
    consider(Coordinates{p[0], p[1], p[2]}, points.index(i));
  }
}

/// Calls consider(point, index) for those points first, first + step, ... below `end` that pass the filter,
/// valid or not. `direction` is rounded to the view's scalar type T.
template <typename T, typename Consider>
void for_each_passing(const PointView& points, std::size_t first, std::size_t step, std::size_t end,
                      const Direction& direction, const RoundedFilter& rounded, const Consider& consider) {
  const FilterOf<T> filter(direction, rounded);
  if (points.order == PointOrder::records && points.indices == nullptr) {
    const auto address = [data = points.data, stride = points.stride](std::size_t i) {
      return data + stride * i;
    };
    for_each_passing(points, address, sizeof(T), first, step, end, filter, consider);
  } else {
    const auto address = [&](std::size_t i) { return points.address(i); };
    for_each_passing(points, address, points.step(), first, step, end, filter, consider);
  }
}

}  // namespace pcl_bv
