// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A host program that has switched denormals off.
#pragma once

#include <cstdint>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace pcl_bv::test {

/// Sets flush-to-zero and denormals-are-zero for this thread while it lives.
class FlushToZero {
 public:
#if defined(__x86_64__)
  FlushToZero() : saved_(_mm_getcsr()) {
    _mm_setcsr(static_cast<unsigned>(saved_) | 0x8040U);
  }
  ~FlushToZero() {
    _mm_setcsr(static_cast<unsigned>(saved_));
  }
#else
  FlushToZero() {
    asm volatile("mrs %0, fpcr" : "=r"(saved_));
    asm volatile("msr fpcr, %0" : : "r"(saved_ | (1ULL << 24)) : "memory");
  }
  ~FlushToZero() {
    asm volatile("msr fpcr, %0" : : "r"(saved_) : "memory");
  }
#endif
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

 private:
  std::uint64_t saved_;
};

}  // namespace pcl_bv::test
