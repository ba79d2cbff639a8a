// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Regions in the points' own type, with the errors that rounding asks for.
#pragma once

#include <vector>

#include "pcl_bv/kernels/region_states.h"

namespace pcl_bv {

template <typename T>
struct PlaneTest {
  T normal[3];
  T inner, outer;  ///< Inside up to the inner one, outside above the outer one.
};

template <typename T>
struct SlabTest {
  T axis[3];
  T slab, core, weight;
};

template <typename T>
struct RegionTest {
  RegionShape shape;
  bool vague;  ///< Too large for sums of T: whatever is in the box is unclear.
  T low[3], high[3];
  T head[3], tail[3];  ///< The centre: rounded, and what that left.
  T reach[3];          ///< From the head to the farther side of the box.
  SlabTest<T> slabs[3];
  T error;  ///< Of distances along axes.
  T square_inner, square_outer;
  T slope;  ///< Of planes: what a point's |q|_1 adds to the error.
  std::vector<PlaneTest<T>> planes;
};

template <typename T>
struct RegionTestsOf {
  T low[3], high[3];  ///< A box around all.
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

}  // namespace pcl_bv
