// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Measures the time of stages.
#pragma once

#include <chrono>
#include <utility>

namespace pcl_bv::detail {

class Stopwatch {
 public:
  /// Returns the seconds since the last lap(), or since construction.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

  /// Returns the seconds since the last lap(), or since construction, without a new lap.
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - last_).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace pcl_bv::detail
