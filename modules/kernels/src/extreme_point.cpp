// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A rounded sum rejects nearly all points; the few that remain are compared exactly.

#include "pcl_bv/kernels/extreme_point.h"

namespace pcl_bv {
namespace {

bool same(const Coordinates& a, const Coordinates& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

void consider(const CubeDirection& direction, const Coordinates& point, std::size_t index,
              ExtremePoint& best) {
  // Many equal points (a cloud of one value, dead beams) need no arithmetic.
  if (best.found && same(point, best.point)) {
    if (index < best.index) best.index = index;
    return;
  }
  if (is_valid(point)) keep_extreme({true, exact_projection(direction, point), point, index}, best);
}

// One end's filter in registers.
template <typename T>
struct Filter {
  Filter(const CubeDirection& direction, const RoundedFilter& filter)
      : a(direction[0]),
        b(direction[1]),
        c(direction[2]),
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
template <typename T, typename Address>
void find(const PointView& points, Address address, std::size_t gap, std::size_t first, std::size_t step,
          std::size_t end, const CubeDirection& direction, const RoundedFilter& rounded, ExtremePoint& best) {
  const Filter<T> filter(direction, rounded);
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
    consider(direction, {p[0], p[1], p[2]}, points.index(i), best);
  }
}

template <typename T>
void find(const PointView& points, std::size_t first, std::size_t step, std::size_t end,
          const CubeDirection& direction, const RoundedFilter& filter, ExtremePoint& best) {
  if (points.order == PointOrder::records && points.indices == nullptr) {
    const auto address = [data = points.data, stride = points.stride](std::size_t i) {
      return data + stride * i;
    };
    find<T>(points, address, sizeof(T), first, step, end, direction, filter, best);
  } else {
    const auto address = [&](std::size_t i) { return points.address(i); };
    find<T>(points, address, points.step(), first, step, end, direction, filter, best);
  }
}

}  // namespace

void keep_extreme(const ExtremePoint& other, ExtremePoint& best) {
  if (!other.found) return;
  const int order = best.found ? compare(other.projection, best.projection) : 1;
  if (order > 0 || (order == 0 && other.index < best.index)) best = other;
}

void find_extreme_point(const PointView& points, std::size_t first, std::size_t step, std::size_t end,
                        const CubeDirection& direction, const RoundedFilter& filter, ExtremePoint& best) {
  if (points.scalar == ScalarType::float32) {
    find<float>(points, first, step, end, direction, filter, best);
  } else {
    find<double>(points, first, step, end, direction, filter, best);
  }
}

}  // namespace pcl_bv
