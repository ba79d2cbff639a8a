// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "track_score.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motion_score.h"

namespace pcl_bv::bench {
namespace {

// A track that has all the points of the object at `place` in the list, and no others.
FoundObject whole(std::uint32_t track, std::size_t place) {
  return {track, 10, {{place, 10}}, false};
}

const std::vector<TrueObject> kTwo{{1, 10}, {2, 10}};

TEST(TrackScore, OfPerfectTracksIsOne) {
  TrackScore score;
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(score.add(kTwo, {whole(7, 0), whole(8, 1)}).size(), 2U);
  const TrackScores result = score.result();
  EXPECT_EQ(result.truths, 10U);
  EXPECT_EQ(result.matches, 10U);
  EXPECT_EQ(result.switches + result.wrong + result.misses + result.fragments, 0U);
  EXPECT_DOUBLE_EQ(result.mota, 1);
  EXPECT_DOUBLE_EQ(result.hota, 1);
}

TEST(TrackScore, CountsSwitchesMissesAndWhatIsWrong) {
  TrackScore score;
  score.add(kTwo, {whole(7, 0), whole(8, 1)});
  score.add(kTwo, {whole(8, 0), whole(7, 1)});                           // both have changed
  score.add(kTwo, {whole(8, 0)});                                        // one is missed
  score.add(kTwo, {whole(8, 0), whole(7, 1), {9, 5, {{0, 1}}, false}});  // it is back; one too many
  const TrackScores result = score.result();
  EXPECT_EQ(result.switches, 2U);
  EXPECT_EQ(result.misses, 1U);
  EXPECT_EQ(result.wrong, 1U);
  EXPECT_EQ(result.fragments, 1U);
  EXPECT_DOUBLE_EQ(result.mota, 1 - 4.0 / 8);
}

TEST(TrackScore, HalfOfAnObjectIsNoMatchAndOtherThingsAreNotCounted) {
  TrackScore score;
  EXPECT_TRUE(score.add({{1, 10}}, {{5, 5, {{0, 5}}, false}}).empty());
  EXPECT_TRUE(score.add({{1, 10}}, {{6, 90, {{0, 10}}, true}}).empty());
  const TrackScores result = score.result();
  EXPECT_EQ(result.misses, 2U);
  EXPECT_EQ(result.wrong, 1U);
}

// One object, two tracks of three frames each: association is 3 / 6 everywhere, detection 1.
TEST(TrackScore, AssociationIsWhatTracksAndObjectsHaveInCommon) {
  TrackScore score;
  for (int i = 0; i < 6; ++i)
    score.add({{1, 10}}, {whole(i < 3 ? 4U : 5U, 0)});
  const TrackScores result = score.result();
  EXPECT_DOUBLE_EQ(result.association, 0.5);
  EXPECT_DOUBLE_EQ(result.detection, 1);
  EXPECT_DOUBLE_EQ(result.hota, std::sqrt(0.5));
  EXPECT_EQ(result.switches, 1U);
}

// Similarity 0.6: matches up to the twelfth of the nineteen thresholds.
TEST(TrackScore, HotaIsTheMeanOverThresholds) {
  TrackScore score;
  score.add({{1, 10}}, {{4, 6, {{0, 6}}, false}});
  EXPECT_DOUBLE_EQ(score.result().detection, 12.0 / 19);
  EXPECT_DOUBLE_EQ(score.result().hota, 12.0 / 19);
}

TEST(TrackScore, IdsOfAnotherSequenceAreOthers) {
  TrackScore score;
  score.add({{1, 10}}, {whole(7, 0)});
  score.start_sequence();
  score.add({{1, 10}}, {whole(8, 0)});
  EXPECT_EQ(score.result().switches, 0U);
  score.start_sequence();
  score.add({{1, 10}}, {whole(7, 0)});
  EXPECT_DOUBLE_EQ(score.result().association, 1);
}

MotionSighting standing(double turn, double length) {
  MotionSighting sighting;
  sighting.object = sighting.track = 1;
  sighting.velocity = sighting.true_velocity = Eigen::Vector3d::Zero();
  sighting.turn = turn;
  sighting.length = length;
  return sighting;
}

TEST(MotionScore, TellsFlipsFromJitter) {
  MotionScore score;
  for (const double degrees : {10.0, 12.0, 191.0, 11.0, 11.0})  // 191: turned round, and 1 degree off
    score.add(standing(degrees * 3.14159265358979 / 180, degrees == 12 ? 4.5 : 4));
  EXPECT_EQ(score.flips(), 2U);
  EXPECT_EQ(score.boxes(), 5U);
  EXPECT_NEAR(score.turn_jitter(1), 1, 1e-9);
  EXPECT_NEAR(score.turn_jitter(0.5), 0, 1e-9);
  EXPECT_DOUBLE_EQ(score.length_jitter(1), 0.5);
}

TEST(MotionScore, AsksStandingAndMovingObjectsApart) {
  MotionScore score;
  MotionSighting sighting = standing(0, 4);
  sighting.moving = true;
  score.add(sighting);
  sighting.true_velocity = {1, 0, 0};
  sighting.velocity = {1, 0.5, 9};  // heights do not count
  for (int i = 0; i < 3; ++i)
    score.add(sighting);
  EXPECT_DOUBLE_EQ(score.standing_right(), 0);
  EXPECT_DOUBLE_EQ(score.moving_right(), 1);
  EXPECT_DOUBLE_EQ(score.right(), 0.75);
  EXPECT_DOUBLE_EQ(score.velocity_error(1), 0.5);
}

}  // namespace
}  // namespace pcl_bv::bench
