// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A histogram of durations in constant memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace [[gnu::visibility("default")]] pcl_bv {

/// Percentiles of durations from 1 us to 1000 s, accurate to 1 %. A histogram with logarithmic bins, each 1 %
/// longer than the bin before. Never allocates.
class LatencyHistogram {
 public:
  /// Adds a duration in milliseconds. Durations below 1 us go into the first bin and durations above 1000 s
  /// into the last bin, but max() is exact. Negative durations and NaN are treated as 0.
  void add(double milliseconds);

  std::uint64_t count() const { return count_; }
  double max() const { return max_; }  ///< Longest duration, milliseconds; 0 if empty.

  /// Returns the duration, milliseconds, that a `share` (0 to 1) of all durations does not exceed. It is the
  /// nearest rank, at most 1 % above the exact value. Returns 0 if the histogram is empty.
  double percentile(double share) const;

 private:
  static constexpr std::size_t kBinCount = 2084;  // ln(1e9) / ln(1.01) + 1
  std::array<std::uint32_t, kBinCount> bins_{};
  std::uint64_t count_ = 0;
  double max_ = 0;
};

}  // namespace pcl_bv
