// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/frame_result.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace pcl_bv::detail {
namespace {

TEST(LatencyHistogram, PercentilesAreTheNearestRankToOnePercent) {
  std::mt19937_64 random(1);
  std::lognormal_distribution<double> draw(1, 1.5);
  LatencyHistogram histogram;
  std::vector<double> all;
  for (int i = 0; i < 10'007; ++i) {
    all.push_back(draw(random));
    histogram.add(all.back());
  }
  std::sort(all.begin(), all.end());
  for (const double part : {0.001, 0.5, 0.95, 0.99, 1.0}) {
    const double exact = all[static_cast<std::size_t>(std::ceil(part * static_cast<double>(all.size()))) - 1];
    EXPECT_GE(histogram.percentile(part), exact * (1 - 1e-12)) << part;
    EXPECT_LE(histogram.percentile(part), exact * 1.0101) << part;
  }
  EXPECT_EQ(histogram.max(), all.back());
  EXPECT_EQ(histogram.count(), all.size());
}

TEST(LatencyHistogram, HoldsAnyDuration) {
  LatencyHistogram histogram;
  EXPECT_EQ(histogram.percentile(0.5), 0);
  for (const double ms : {0.0, 1e-9, 1e12, -1.0, std::nan("")})
    histogram.add(ms);
  EXPECT_EQ(histogram.max(), 1e12);
  EXPECT_LE(histogram.percentile(0.5), 1e-3);
}

}  // namespace
}  // namespace pcl_bv::detail
