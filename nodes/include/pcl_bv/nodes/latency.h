// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How long things took, in a bounded space.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace [[gnu::visibility("default")]] pcl_bv {

/// Percentiles of durations from 1 us to 1000 s, to 1 %: a histogram whose classes grow by that. No
/// allocation, whatever the number of durations.
class LatencyHistogram {
 public:
  /// Milliseconds; what is shorter or longer counts as the least or greatest class, but max() is exact.
  void add(double milliseconds);

  std::uint64_t count() const { return count_; }
  double max() const { return max_; }  ///< Milliseconds; 0 without any.

  /// The duration that a part of all, from 0 to 1, do not exceed: the nearest rank, milliseconds, at most 1 %
  /// above the true one. 0 without any.
  double percentile(double part) const;

 private:
  static constexpr std::size_t kClasses = 2084;  // ln(1e9) / ln(1.01), and one
  std::array<std::uint32_t, kClasses> classes_{};
  std::uint64_t count_ = 0;
  double max_ = 0;
};

}  // namespace pcl_bv
