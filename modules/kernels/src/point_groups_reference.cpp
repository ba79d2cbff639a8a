// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "references.h"

namespace pcl_bv {
namespace {

template <typename T>
void fill(const PointView& points, std::size_t pad, std::byte* groups) {
  constexpr std::size_t lanes = kGroupBytes / sizeof(T);
  for (std::size_t i = 0; i < points.count || i % lanes != 0; ++i) {
    T v[3];
    load_point(points, i < points.count ? i : pad, v);
    std::byte* group = groups + i / lanes * (3 * kGroupBytes);
    for (std::size_t axis = 0; axis < 3; ++axis)
      std::memcpy(group + axis * kGroupBytes + i % lanes * sizeof(T), &v[axis], sizeof(T));
  }
}

}  // namespace

void fill_groups_reference(const PointView& points, std::size_t pad, std::byte* groups) {
  points.scalar == ScalarType::float64 ? fill<double>(points, pad, groups) : fill<float>(points, pad, groups);
}

}  // namespace pcl_bv
