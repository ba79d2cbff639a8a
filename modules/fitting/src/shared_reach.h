// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What the chunks of a cloud tell one another while they run.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>

#include "pcl_bv/numeric/constants.h"

namespace pcl_bv {

/// What all chunks so far are known to reach at each end, -infinity at first. Which chunk sees what depends
/// on timing; no result may.
template <std::size_t ends>
class SharedReach {
 public:
  SharedReach() {
    for (std::atomic<double>& r : reached_)
      r.store(-kInfinity, std::memory_order_relaxed);
  }

  std::array<double, ends> snapshot() const {
    std::array<double, ends> out;
    for (std::size_t end = 0; end < ends; ++end)
      out[end] = reached_[end].load(std::memory_order_relaxed);
    return out;
  }

  void raise(std::size_t end, double reach) {
    double known = reached_[end].load(std::memory_order_relaxed);
    while (known < reach && !reached_[end].compare_exchange_weak(known, reach, std::memory_order_relaxed)) {
    }
  }

 private:
  std::array<std::atomic<double>, ends> reached_;
};

}  // namespace pcl_bv
