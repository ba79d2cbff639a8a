// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Regions in the points' own type. Each surface has become two thresholds, as far apart as rounding asks for:
// what is at or below the inner one is inside, what is above the outer one is outside.
#pragma once

#include <vector>

#include "pcl_bv/kernels/region_states.h"

namespace pcl_bv {

template <typename T>
struct PlaneTest {
  T normal[3];
  T inner, outer;
};

template <typename T>
struct SlabTest {
  T axis[3];
  T inner, outer;
  T core, weight;
};

template <typename T>
struct RegionTest {
  RegionShape shape;
  T low[3], high[3];
  T head[3], tail[3];  ///< The centre: rounded, and what that left.
  SlabTest<T> slabs[3];
  T square_inner, square_outer;
  T slope;  ///< Of planes: what a point's distance |q|_1 adds to the doubt.
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
