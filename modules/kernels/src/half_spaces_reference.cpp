// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "references.h"

namespace pcl_bv {
namespace {

template <typename T>
bool is_inside(const T (&p)[3], const HalfSpaces& inside) {
  const T x = p[0] - static_cast<T>(inside.center.x);
  const T y = p[1] - static_cast<T>(inside.center.y);
  const T z = p[2] - static_cast<T>(inside.center.z);
  if ((x * x + y * y) + z * z < static_cast<T>(inside.squared_ball)) return true;
  for (std::size_t k = 0; k < inside.count; ++k) {
    const HalfSpace& h = inside.planes[k];
    const T reach = (static_cast<T>(h.x) * x + static_cast<T>(h.y) * y) + static_cast<T>(h.z) * z;
    if (!(reach < static_cast<T>(h.limit))) return false;
  }
  return inside.count > 0;
}

template <typename T>
std::size_t list(const PointView& points, const HalfSpaces& inside, std::uint32_t* positions) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    T p[3];
    load_point(points, i, p);
    if (!is_inside(p, inside)) positions[count++] = static_cast<std::uint32_t>(i);
  }
  return count;
}

}  // namespace

std::size_t list_outside_reference(const PointView& points, const HalfSpaces& inside,
                                   std::uint32_t* positions) {
  return points.scalar == ScalarType::float64 ? list<double>(points, inside, positions)
                                              : list<float>(points, inside, positions);
}

}  // namespace pcl_bv
