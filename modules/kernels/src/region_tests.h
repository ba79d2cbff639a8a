// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Regions in the points' scalar type, with margins for rounding errors.
#pragma once

#include <vector>

#include "pcl_bv/kernels/region_states.h"

namespace pcl_bv::detail {

template <typename T>
struct PlaneTest {
  T normal[3];
  T inner, outer;  ///< Inside if n . q is at most `inner`, outside if it exceeds `outer`.
};

template <typename T>
struct SlabTest {
  T axis[3];
  T slab, core, weight;
};

template <typename T>
struct RegionTest {
  RegionShape shape;
  bool undecidable;  ///< Coordinates are too large for sums in T, so all points in the box are unclear.
  T low[3], high[3];
  T head[3], tail[3];  ///< The centre rounded to T, and the remainder.
  T max_offset[3];     ///< Upper bound of |p - head| on each axis, for p in the box.
  SlabTest<T> slabs[3];
  T error;                       ///< Error bound of distances along axes.
  T square_inner, square_outer;  ///< For ball and rounded: squared radii, used like `inner` and `outer`.
  T slope;                       ///< For planes: slope * |q|_1 is the part of the error that depends on q.
  std::vector<PlaneTest<T>> planes;
};

template <typename T>
struct RegionTestsOf {
  T low[3], high[3];  ///< A box around all regions.
  std::vector<RegionTest<T>> regions;
};

struct RegionTests::Prepared {
  RegionTestsOf<float> floats;
  RegionTestsOf<double> doubles;

  template <typename T>
  const RegionTestsOf<T>& of() const {
    if constexpr (sizeof(T) == 4) {
      return floats;
    } else {
      return doubles;
    }
  }
};

}  // namespace pcl_bv::detail
