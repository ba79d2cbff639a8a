// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Doubles the number of things that an input names, and measures what reading it allocates. Programs that ask
// compile allocations.cpp. Times are printed only: an input is so large that quadratic work does not end.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <ctime>
#include <functional>
#include <iostream>
#include <string>

#include "allocations.h"

namespace pcl_bv::test {

struct Work {
  std::size_t calls = 0, bytes = 0;  ///< Of operator new.
  double seconds = 0;                ///< Of the processor.
};

inline Work work_of(const std::function<void()>& read) {
  const std::size_t calls = allocations(), bytes = allocated_bytes();
  const std::clock_t begin = std::clock();
  read();
  return {allocations() - calls, allocated_bytes() - bytes,
          static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC};
}

/// Makes inputs of n, 2 n and 4 n things, and reads them. Expects that the number of allocations and their
/// bytes at most double each time, and are at most `multiple` times the bytes of the input.
/// `make(n)` writes an input and returns its bytes.
inline void expect_linear(const std::string& what, std::size_t n, double multiple,
                          const std::function<std::size_t(std::size_t)>& make,
                          const std::function<void()>& read) {
  constexpr double slack = 1.15, constant = 1 << 20;
  Work before;
  for (const std::size_t factor : {1, 2, 4}) {
    const auto size = static_cast<double>(make(factor * n));
    const Work work = work_of(read);
    std::cout << what << ' ' << factor * n << ": " << size << " bytes, " << work.calls << " allocations of "
              << work.bytes << " bytes, " << work.seconds << " s\n";
    EXPECT_LE(static_cast<double>(work.bytes), multiple * size + constant) << what << ' ' << factor * n;
    if (factor > 1) {
      EXPECT_LE(static_cast<double>(work.calls), 2 * slack * static_cast<double>(before.calls) + 1000)
          << what;
      EXPECT_LE(static_cast<double>(work.bytes), 2 * slack * static_cast<double>(before.bytes) + constant)
          << what;
    }
    before = work;
  }
}

}  // namespace pcl_bv::test
