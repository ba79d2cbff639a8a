// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The bins have equal width in the logarithm of the duration.

#include "pcl_bv/nodes/frame_result.h"

#include <algorithm>
#include <cmath>

namespace pcl_bv {
namespace {

constexpr double kShortest = 1e-3;  // milliseconds
constexpr double kGrowth = 1.01;

}  // namespace

void LatencyHistogram::add(double milliseconds) {
  if (!(milliseconds >= 0)) milliseconds = 0;  // also NaN
  milliseconds = std::min(milliseconds, 1e15);
  const double steps = std::log(std::max(milliseconds, kShortest) / kShortest) / std::log(kGrowth);
  ++bins_[std::min(static_cast<std::size_t>(std::ceil(steps)), kBinCount - 1)];
  ++count_;
  max_ = std::max(max_, milliseconds);
}

double LatencyHistogram::percentile(double share) const {
  const auto rank = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < kBinCount && count_ > 0; ++i) {
    below += bins_[i];
    if (below >= std::max<std::uint64_t>(rank, 1)) {
      return std::min(max_, kShortest * std::pow(kGrowth, static_cast<double>(i)));
    }
  }
  return max_;
}

}  // namespace pcl_bv
