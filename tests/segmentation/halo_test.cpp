// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include "pcl_bv/segmentation/clusters.h"
#include "stored/distributed_points.h"

namespace pcl_bv::detail {
namespace {

// The tolerance is squared and the halo measured in rounded arithmetic: the excess of 2^-22 to 1e-5 covers
// it.
TEST(Halo, SlightlyExceedsOneToleranceOrTwoIfMinPointsIsAbove1) {
  for (const float tolerance : {0x1p-20F, 0.1F, 0.3F, 0.5F, 1.7F, 1000.0F}) {
    for (const ScalarType scalar : {ScalarType::float32, ScalarType::float64}) {
      for (const int min_points : {1, 2, 10}) {
        ClusterOptions options;
        options.tolerance = tolerance;
        options.min_points = min_points;
        const double tolerances = halo_of(options, scalar) / tolerance;
        const int needed = min_points > 1 ? 2 : 1;
        EXPECT_GT(tolerances, needed * (1 + 0x1p-22)) << tolerance << ", " << min_points;
        EXPECT_LT(tolerances, needed * (1 + 1e-5)) << tolerance << ", " << min_points;
      }
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
