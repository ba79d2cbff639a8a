// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where tests have less to do, because they are slow there.
#pragma once

namespace pcl_bv::test {

// qemu runs tests about 17 times slower. There they use clouds just large enough.
#if defined(PCL_BV_EMULATED)
inline constexpr bool kEmulated = true;
#else
inline constexpr bool kEmulated = false;
#endif

// Sanitizers run tests 3 to 10 times slower. They look for wrong use of memory and threads, not for wrong
// numbers, so tests of many random cases or executions have fewer there and under qemu.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kFewCases = true;
#else
inline constexpr bool kFewCases = kEmulated;
#endif

}  // namespace pcl_bv::test
