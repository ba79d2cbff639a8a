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

/// Makes inputs of n, 2 n and 4 n things, and reads them. Expects that the allocations of the last are about
/// four times those of the first, in number and bytes, and their bytes at most `multiple` times those of the
/// input. A buffer may grow in one of the two steps only, so the second is not compared.
/// `make(n)` writes an input and returns its bytes.
inline void expect_linear(const std::string& what, std::size_t n, double multiple,
                          const std::function<std::size_t(std::size_t)>& make,
                          const std::function<void()>& read) {
  constexpr double slack = 1.15, constant = 1 << 20;
  Work first;
  for (const std::size_t factor : {1, 2, 4}) {
    const auto size = static_cast<double>(make(factor * n));
    const Work work = work_of(read);
    std::cout << what << ' ' << factor * n << ": " << size << " bytes, " << work.calls << " allocations of "
              << work.bytes << " bytes, " << work.seconds << " s\n";
    EXPECT_LE(static_cast<double>(work.bytes), multiple * size + constant) << what << ' ' << factor * n;
    if (factor == 1) first = work;
    if (factor == 4) {
      EXPECT_LE(static_cast<double>(work.calls), 4 * slack * static_cast<double>(first.calls) + 1000) << what;
      EXPECT_LE(static_cast<double>(work.bytes), 4 * slack * static_cast<double>(first.bytes) + constant)
          << what;
    }
  }
}

}  // namespace pcl_bv::test
