// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of the direction sets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <vector>

#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;

TEST(KdopSet, BuiltInDirectionsComeInTheDocumentedOrder) {
  const std::vector<Vector3d> all = {{1, 0, 0},  {0, 1, 0},   {0, 0, 1}, {1, 1, 1},  {1, 1, -1},
                                     {1, -1, 1}, {1, -1, -1}, {1, 1, 0}, {1, -1, 0}, {1, 0, 1},
                                     {1, 0, -1}, {0, 1, 1},   {0, 1, -1}};
  std::vector<Vector3d> axes_and_edges(all.begin(), all.begin() + 3);
  axes_and_edges.insert(axes_and_edges.end(), all.begin() + 7, all.end());
  EXPECT_EQ(*KdopSet::dop6(), KdopSet({all.begin(), all.begin() + 3}));
  EXPECT_EQ(*KdopSet::dop14(), KdopSet({all.begin(), all.begin() + 7}));
  EXPECT_EQ(*KdopSet::dop18(), KdopSet(axes_and_edges));
  EXPECT_EQ(*KdopSet::dop26(), KdopSet(all));
  EXPECT_NE(*KdopSet::dop6(), *KdopSet::dop14());
}

TEST(KdopSet, BuiltInBasisIsTheAxes) {
  for (const auto& set : {KdopSet::dop6(), KdopSet::dop14(), KdopSet::dop18(), KdopSet::dop26()}) {
    EXPECT_EQ(set->basis(), (std::array<std::size_t, 3>{0, 1, 2}));
  }
}

TEST(KdopSet, BuiltInPointersCountNoReferences) {
  const auto copy = KdopSet::dop26();
  EXPECT_EQ(copy.use_count(), 0);
  EXPECT_EQ(copy.get(), KdopSet::dop26().get());
}

TEST(KdopSet, RefusesTooFewAndTooMany) {
  EXPECT_THROW(KdopSet({{1, 0, 0}, {0, 1, 0}}), std::invalid_argument);
  EXPECT_THROW(KdopSet(std::vector<Vector3d>(50, Vector3d::UnitX())), std::invalid_argument);
}

TEST(KdopSet, RefusesZeroAndNonFiniteDirections) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(KdopSet({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(KdopSet({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, nan, 1}}), std::invalid_argument);
}

TEST(KdopSet, RequiresALargestComponentFrom1em30To1e30) {
  for (const double length : {1e-30, -1e30})
    EXPECT_NO_THROW(KdopSet({{1, 0, 0}, {0, 1, 0}, {0, 0, length}})) << length;
  for (const double length : {0.9e-30, -1.1e30})
    EXPECT_THROW(KdopSet({{1, 0, 0}, {0, 1, 0}, {0, 0, length}}), std::invalid_argument) << length;
}

TEST(KdopSet, RefusesDirectionsOfAPlane) {
  EXPECT_THROW(KdopSet({{1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, -0.1, 0}}), std::invalid_argument);
  EXPECT_THROW(KdopSet({{1, 2, 3}, {1, 2, 3}, {-1, -2, -3}}), std::invalid_argument);
}

TEST(KdopSet, FindsABasisWhereverItIs) {
  const KdopSet set({{1, 1, 0}, {2, 2, 0}, {1, 1.001, 0}, {1, -1, 0}, {0, 0, 1e-3}});
  EXPECT_THAT(set.basis(), ::testing::UnorderedElementsAre(0, 3, 4));
}

}  // namespace
}  // namespace pcl_bv::detail
