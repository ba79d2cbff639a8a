// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Selects the targets for which Highway compiles the kernels, and looks up a kernel by instruction set.
// Include this header before any Highway header.
#pragma once

// SSE2 and SSSE3 are disabled, because they gain nothing over SSE4 and the scalar reference. The specialised
// targets (AVX3_DL to AVX3_SPR, SVE_256 and SVE2_128) only repeat the general targets. In Highway 1.0.5 or
// later, the NEON target requires AES instructions. No kernel uses them, and a Raspberry Pi 4 lacks them.
// PCL_BV_EXCLUDED_TARGETS are the targets that the option PCL_BV_ISAS of CMake leaves out.
#ifndef PCL_BV_EXCLUDED_TARGETS
#define PCL_BV_EXCLUDED_TARGETS 0
#endif
#define HWY_DISABLED_TARGETS                                                                                \
  (HWY_SSE2 | HWY_SSSE3 | HWY_AVX3_DL | HWY_AVX3_ZEN4 | HWY_AVX3_SPR | PCL_BV_NEON_WITH_AES | HWY_SVE_256 | \
   HWY_SVE2_128 | PCL_BV_EXCLUDED_TARGETS)
#define HWY_BROKEN_EMU128 1  // without SIMD the scalar reference runs

#include <hwy/detect_targets.h>

#if defined(HWY_NEON_WITHOUT_AES)
#define PCL_BV_NEON HWY_NEON_WITHOUT_AES
#define PCL_BV_NEON_WITH_AES (HWY_NEON | HWY_NEON_BF16)
#define PCL_BV_CHOOSE_NEON HWY_CHOOSE_NEON_WITHOUT_AES
#else
#define PCL_BV_NEON HWY_NEON
#define PCL_BV_NEON_WITH_AES 0
#define PCL_BV_CHOOSE_NEON HWY_CHOOSE_NEON
#endif
// Older versions of Highway do not define these targets.
#if !defined(HWY_SSE2)
#define HWY_SSE2 0
#endif
#if !defined(HWY_AVX3_ZEN4)
#define HWY_AVX3_ZEN4 0
#endif
#if !defined(HWY_AVX3_SPR)
#define HWY_AVX3_SPR 0
#endif
#if !defined(HWY_NEON_BF16)
#define HWY_NEON_BF16 0
#endif

#include <cstddef>

#include "pcl_bv/points/isa.h"

namespace pcl_bv::detail {

/// The versions of one kernel, one function per Isa, in the order of the enumeration. The function is null if
/// the target is not compiled.
template <typename Function>
struct KernelTable {
  Function* entries[8];
  Function* operator[](UsableIsa isa) const { return entries[static_cast<std::size_t>(Isa{isa})]; }
};
template <typename Function, typename... Others>
KernelTable(std::nullptr_t, Function*, Others...) -> KernelTable<Function>;

}  // namespace pcl_bv::detail

/// The initialiser of a KernelTable. The source that uses this macro must define `function` in every
/// HWY_NAMESPACE except N_SCALAR. `reference` is the version for Isa::scalar. Use the macro inside HWY_ONCE.
#define PCL_BV_KERNEL_TABLE(function, reference)                                                         \
  {                                                                                                      \
    nullptr, reference, HWY_CHOOSE_SSE4(function), HWY_CHOOSE_AVX2(function), HWY_CHOOSE_AVX3(function), \
        PCL_BV_CHOOSE_NEON(function), HWY_CHOOSE_SVE(function), HWY_CHOOSE_SVE2(function)                \
  }
