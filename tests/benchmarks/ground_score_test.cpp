// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ground_score.h"

#include <gtest/gtest.h>

#include <vector>

namespace pcl_bv::bench {
namespace {

struct Sweep {
  std::vector<double> range;
  std::vector<std::uint32_t> object, ground, vegetation;
  std::vector<std::uint8_t> found;

  void add(std::size_t count, double at, std::uint32_t id, bool is_ground, bool is_grass, bool called) {
    range.insert(range.end(), count, at);
    object.insert(object.end(), count, id);
    ground.insert(ground.end(), count, is_ground);
    vegetation.insert(vegetation.end(), count, is_grass);
    found.insert(found.end(), count, called);
  }

  GroundScore score(Vegetation rule) const {
    GroundScore score(rule);
    score.add({range, object, ground, vegetation, found});
    return score;
  }
};

TEST(GroundScore, CountsRecallAndPrecisionByRange) {
  Sweep sweep;
  sweep.add(6, 5, 0, true, false, true);
  sweep.add(2, 5, 0, true, false, false);
  sweep.add(4, 5, 1, false, false, true);
  sweep.add(1, 10, 0, true, false, true);   // the second band begins here
  sweep.add(9, 60, 0, true, false, false);  // beyond the last
  sweep.add(9, 0, 0, true, false, false);   // no return
  const GroundScore score = sweep.score(Vegetation::ground);
  EXPECT_DOUBLE_EQ(score.recall(0), 0.75);
  EXPECT_DOUBLE_EQ(score.precision(0), 0.6);
  EXPECT_DOUBLE_EQ(score.recall(1), 1);
  EXPECT_DOUBLE_EQ(score.recall(3), 1);  // none there
  EXPECT_DOUBLE_EQ(score.recall(GroundScore::all), 7.0 / 9);
  EXPECT_DOUBLE_EQ(score.precision(GroundScore::all), 7.0 / 11);
}

TEST(GroundScore, TakesGrassEitherWayOrNotAtAll) {
  Sweep sweep;
  sweep.add(5, 5, 0, true, false, true);
  sweep.add(3, 5, 0, false, true, true);
  sweep.add(2, 5, 0, false, true, false);
  EXPECT_DOUBLE_EQ(sweep.score(Vegetation::ground).recall(0), 0.8);
  EXPECT_DOUBLE_EQ(sweep.score(Vegetation::ground).precision(0), 1);
  EXPECT_DOUBLE_EQ(sweep.score(Vegetation::no_ground).recall(0), 1);
  EXPECT_DOUBLE_EQ(sweep.score(Vegetation::no_ground).precision(0), 0.625);
  EXPECT_DOUBLE_EQ(sweep.score(Vegetation::not_counted).recall(0), 1);
  EXPECT_DOUBLE_EQ(sweep.score(Vegetation::not_counted).precision(0), 1);
}

TEST(GroundScore, AnObjectIsLostWhereMoreThanHalfOfTenPointsAreGround) {
  Sweep sweep;
  sweep.add(5, 15, 1, false, false, false);  // half remain: kept
  sweep.add(5, 25, 1, false, false, true);
  sweep.add(4, 15, 2, false, false, false);  // lost
  sweep.add(6, 15, 2, false, false, true);
  sweep.add(9, 15, 3, false, false, true);  // too few points to count
  const GroundScore score = sweep.score(Vegetation::ground);
  EXPECT_EQ(score.objects(1), 2U);
  EXPECT_EQ(score.lost(1), 1U);
  EXPECT_EQ(score.objects(2), 0U);
  EXPECT_EQ(score.objects(GroundScore::all), 2U);
  EXPECT_EQ(score.lost(GroundScore::all), 1U);
}

}  // namespace
}  // namespace pcl_bv::bench
