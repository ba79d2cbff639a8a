// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What Highway compiles, and how a target is found by name. Include before any Highway header.
#pragma once

// SSSE3 gains nothing over SSE4; the specialised targets repeat the general ones.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE_256 | HWY_SVE2_128)

#include <cstddef>

#include "pcl_bv/kernels/isa.h"

namespace pcl_bv {

/// One entry per Isa, in the order of the enumeration; null where the target is not compiled.
template <typename Function>
struct KernelTable {
  Function* entries[8];
  Function* operator[](Isa isa) const { return entries[static_cast<std::size_t>(isa)]; }
};

}  // namespace pcl_bv

/// A KernelTable of a function that each HWY_NAMESPACE of this file defines; use inside HWY_ONCE.
#define PCL_BV_KERNEL_TABLE(function, reference)                                                           \
  {                                                                                                        \
    {                                                                                                      \
      nullptr, reference, HWY_CHOOSE_SSE4(function), HWY_CHOOSE_AVX2(function), HWY_CHOOSE_AVX3(function), \
          HWY_CHOOSE_NEON(function), HWY_CHOOSE_SVE(function), HWY_CHOOSE_SVE2(function)                   \
    }                                                                                                      \
  }
