// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What a tracker is made of.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <numeric>
#include <random>

#include "pipeline/track/assignment.h"
#include "pipeline/track/ego_motion.h"
#include "pipeline/track/motion_filter.h"
#include "pipeline/track/occlusion.h"
#include "pipeline/track/track.h"
#include "pipeline/tracked_volumes.h"

namespace pcl_bv::detail {
namespace {

double uniform(std::mt19937& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
}

TEST(TrackClock, GoesOnWhereStampsJump) {
  constexpr std::int64_t late = 5'000'000'000'000'000'000;
  for (const bool recorded : {false, true}) {
    TrackClock clock;
    std::int64_t before = clock.at(late, recorded ? late : 0);
    for (int i = 0; i < 20; ++i) {
      const std::int64_t stamp = i % 2 == 0 ? 1 : late;  // a driver that writes none now and then
      const std::int64_t now = clock.at(recorded ? 0 : stamp, recorded ? stamp : 0);
      EXPECT_GE(now, before) << i;
      before = now;
    }
    const std::int64_t next = clock.at(late + 100'000'000, late + 100'000'000);
    EXPECT_EQ(next, before + 100'000'000);
  }
}

TEST(TrackClock, StartsAtAnyStamp) {
  TrackClock clock;
  const std::int64_t begin = clock.at(INT64_MAX - 1'000'000'000, 0);
  EXPECT_EQ(clock.at(INT64_MAX - 500'000'000, 0), begin + 500'000'000);
  for (int i = 0; i < 10; ++i) {
    clock.at(0, 0);
    EXPECT_GE(clock.at(INT64_MAX, 0), begin);
  }
}

TEST(MotionFilter, ManySmallStepsAreOneLarge) {
  AxisFilter one{1, 2, 0.5, 0.1, 3}, many = one;
  one.predict(0.1, 0.9);
  for (int i = 0; i < 100; ++i)
    many.predict(0.001, 0.9);
  EXPECT_NEAR(many.position, one.position, 1e-12);
  EXPECT_NEAR(many.position_variance, one.position_variance, 1e-12);
  EXPECT_NEAR(many.covariance, one.covariance, 1e-12);
  EXPECT_NEAR(many.velocity_variance, one.velocity_variance, 1e-12);
}

TEST(MotionFilter, CovarianceStaysPositiveDefiniteHoweverStampsJitter) {
  std::mt19937 random(19);
  for (int run = 0; run < 100; ++run) {
    AxisFilter axis{0, 0, 0.01, 0, 64};
    for (int i = 0; i < 300; ++i) {
      const double steps[] = {0, 1e-9, 0.001, 0.1, 1}, variances[] = {1e-6, 0.01, 100};
      axis.predict(steps[random() % 5], 0.9);
      axis.correct(uniform(random, -1, 1), variances[random() % 3]);
      ASSERT_GT(axis.position_variance, 0) << run << ' ' << i;
      ASSERT_GT(axis.position_variance * axis.velocity_variance, axis.covariance * axis.covariance)
          << run << ' ' << i;
    }
  }
}

TEST(MotionFilter, ACovarianceIsThatOfWhatItEstimates) {
  std::mt19937 random(7);  // normalised error squared of a two-state filter: 2 on average
  double sum = 0;
  constexpr int runs = 2000;
  const auto normal = [&] {
    double all = -6;
    for (int i = 0; i < 12; ++i)
      all += uniform(random, 0, 1);
    return all;
  };
  for (int run = 0; run < runs; ++run) {
    const double velocity = 8 * normal();
    double place = 0.1 * normal();
    AxisFilter axis{0, 0, 0.01, 0, 64};
    for (int i = 0; i < 15; ++i) {
      place += 0.1 * velocity;
      axis.predict(0.1, 0);
      axis.correct(place + 0.1 * normal() - axis.position, 0.01);
    }
    Eigen::Matrix2d covariance;
    covariance << axis.position_variance, axis.covariance, axis.covariance, axis.velocity_variance;
    const Eigen::Vector2d error(axis.position - place, axis.velocity - velocity);
    sum += error.dot(covariance.inverse() * error);
  }
  EXPECT_NEAR(sum / runs, 2, 0.15);
}

// The least sum over all ways, by trying them.
double least_cost(std::size_t row, std::size_t rows, std::vector<char>& taken,
                  const std::vector<AssignmentPair>& pairs, double alone) {
  if (row == rows) return 0;
  double least = alone + least_cost(row + 1, rows, taken, pairs, alone);
  for (const AssignmentPair& pair : pairs) {
    if (pair.row != row || taken[pair.column] != 0) continue;
    taken[pair.column] = 1;
    least = std::min(least, pair.cost + least_cost(row + 1, rows, taken, pairs, alone));
    taken[pair.column] = 0;
  }
  return least;
}

TEST(SparseAssignment, CostsWhatTheBestOfAllWaysCosts) {
  SparseAssignment assignment;
  for (unsigned seed = 0; seed < 400; ++seed) {
    std::mt19937 random(seed);
    const std::size_t rows = random() % 7, columns = 1 + random() % 6;
    std::vector<AssignmentPair> pairs;
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t c = 0; c < columns; ++c)
        if (random() % 3 != 0) pairs.push_back({r, c, static_cast<double>(random() % 12)});  // with ties
    assignment.solve(rows, columns, pairs, 8);
    std::vector<char> taken(columns, 0);
    double sum = 0;
    for (std::size_t r = 0; r < rows; ++r) {
      const std::size_t c = assignment.columns()[r];
      const auto pair = std::find_if(pairs.begin(), pairs.end(),
                                     [&](const AssignmentPair& p) { return p.row == r && p.column == c; });
      if (c == SparseAssignment::none) {
        sum += 8;
        continue;
      }
      ASSERT_NE(pair, pairs.end()) << "seed " << seed;
      ASSERT_EQ(taken[c], 0) << "seed " << seed;
      taken[c] = 1;
      sum += pair->cost;
    }
    std::fill(taken.begin(), taken.end(), 0);
    ASSERT_DOUBLE_EQ(sum, least_cost(0, rows, taken, pairs, 8)) << "seed " << seed;
  }
}

TEST(SparseAssignment, GivesWayWhereTheNearestForEachCostsMore) {
  SparseAssignment assignment;
  assignment.solve(2, 2, {{0, 0, 1}, {0, 1, 2}, {1, 0, 1}}, 16);
  EXPECT_EQ(assignment.columns(), (std::vector<std::size_t>{1, 0}));
}

Aabb block(const Eigen::Vector2d& at, double size) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(size / 2), center(at.x(), at.y(), 0);
  return {center - half, center + half};
}

TEST(EgoMotion, IsFoundAmongMovingObjectsNoiseAndNewOnes) {
  EgoMotion ego;
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    const PlanarMotion truth{uniform(random, -0.05, 0.05),
                             {uniform(random, -2.5, 2.5), uniform(random, -0.5, 0.5)}};
    std::vector<Aabb> before, after;
    for (int i = 0; i < 60; ++i) {
      const Eigen::Vector2d at(uniform(random, -50, 50), uniform(random, -50, 50));
      const double size = uniform(random, 0.4, 3);
      const Eigen::Vector2d noise(uniform(random, -0.05, 0.05), uniform(random, -0.05, 0.05));
      if (i % 6 != 0) before.push_back(block(at, size));
      const Eigen::Vector2d moves(i % 5 == 0 ? 1.2 : 0, 0);
      if (i % 7 != 0) after.push_back(block(truth * at + moves + noise, size));
    }
    PlanarMotion found;
    ASSERT_TRUE(ego.estimate(before, after, {}, found)) << "seed " << seed;
    EXPECT_NEAR(found.yaw, truth.yaw, 0.004) << "seed " << seed;
    EXPECT_LT((found.shift - truth.shift).norm(), 0.1) << "seed " << seed;
  }
}

TEST(EgoMotion, OfFewOrStrangeBoxesIsNotFound) {
  EgoMotion ego;
  std::mt19937 random(1);
  std::vector<Aabb> five, others;
  for (int i = 0; i < 5; ++i)
    five.push_back(block({10.0 * i, 0}, 1));
  PlanarMotion motion{0.25};
  EXPECT_FALSE(ego.estimate({}, {}, {}, motion));
  EXPECT_FALSE(ego.estimate(five, five, {}, motion));
  std::vector<Aabb> many;
  for (int i = 0; i < 40; ++i) {
    many.push_back(block({uniform(random, -50, 50), uniform(random, -50, 50)}, 1));
    others.push_back(block({uniform(random, -50, 50), uniform(random, -50, 50)}, 3));
  }
  EXPECT_FALSE(ego.estimate(many, others, {}, motion));
  EXPECT_EQ(motion.yaw, 0.25);
}

TEST(PlanarMotion, AndItsInverseLeaveAPlaceWhereItIs) {
  const PlanarMotion motion{0.7, {3, -2}};
  const Eigen::Vector2d place(5, 11);
  EXPECT_LT(((motion.inverse() * (motion * place)) - place).norm(), 1e-12);
  EXPECT_LT((((motion * motion) * place) - motion * (motion * place)).norm(), 1e-12);
}

TEST(Track, PartsThatComeIntoViewAreNoMotion) {
  Track track;
  track.start(block({0, 10}, 1), Pose::Identity());
  for (int i = 1; i < 12; ++i) {  // its left end stays, its right one comes into view, 0.5 m a frame
    track.predict(0.1);
    track.expect(Pose::Identity());
    track.correct({{-0.5, 9.5, -0.5}, {0.5 + 0.5 * i, 10.5, 0.5}}, Pose::Identity(), 0.1);
  }
  EXPECT_LT(track.motion.velocity().norm(), 0.05);
  EXPECT_FALSE(track.moving);
}

// A car ahead comes nearer at 10 m/s, and 0.4 m more of its length come into view in each frame.
TEST(Track, ACarThatComesIntoViewHasTheVelocityOfItsFront) {
  const auto seen = [](int i) { return Aabb({40.0 - i, 2, 0}, {41 - 0.6 * i, 4, 1.5}); };
  Track track;
  track.start(seen(0), Pose::Identity());
  for (int i = 1; i < 9; ++i) {
    track.predict(0.1);
    track.expect(Pose::Identity());
    track.correct(seen(i), Pose::Identity(), 0.1);
  }
  EXPECT_NEAR(track.motion.velocity().x(), -10, 1);
  EXPECT_TRUE(track.moving);
}

// A far car comes nearer at 10 m/s. Its visible length changes from frame to frame, so it is not yet known
// whether it moves.
TEST(Track, ACarInPartsHasAVelocityBeforeItIsKnownToMove) {
  const std::array<Eigen::Vector2d, 6> faces{
      {{30.75, 31.45}, {29.85, 32.15}, {29.0, 32.6}, {27.95, 30.85}, {26.95, 31.05}, {25.95, 29.25}}};
  Track track;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Aabb seen({5, faces[i].x(), 0}, {7, faces[i].y(), 1.2});
    if (i == 0) {
      track.start(seen, Pose::Identity());
      continue;
    }
    track.predict(0.1);
    track.expect(Pose::Identity());
    track.correct(seen, Pose::Identity(), 0.1);
  }
  EXPECT_NEAR(track.motion.velocity().y(), -10, 1);
}

// Another object hides the near half of a parked car for three frames.
TEST(Track, ANearFaceThatIsHiddenIsNoMotion) {
  Track track;
  track.start({{10, 2, 0}, {14, 4, 1.5}}, Pose::Identity());
  for (int i = 1; i < 20; ++i) {
    track.predict(0.1);
    track.expect(Pose::Identity());
    track.correct({{i > 10 && i < 14 ? 12.0 : 10.0, 2, 0}, {14, 4, 1.5}}, Pose::Identity(), 0.1);
    EXPECT_LT(track.motion.velocity().norm(), 0.3) << i;
    EXPECT_FALSE(track.moving) << i;
  }
}

TEST(Track, KeepsTheExtentsOfPartsThatAreHidden) {
  Track track;
  track.start({{10, 2, 0}, {14, 4, 1.5}}, Pose::Identity());
  for (int i = 1; i < 10; ++i) {
    track.predict(0.1);
    track.expect(Pose::Identity());
    track.correct({{10, 2, 0}, {i < 4 ? 14.0 : 11.0, 4, 1.5}}, Pose::Identity(), 0.1);
  }
  EXPECT_NEAR(track.high.x() - track.low.x(), 1, 0.2);
  EXPECT_GT(track.full_high.x() - track.full_low.x(), 3.4);
  EXPECT_NEAR(track.expected_position.x() + track.full_low.x(), 10, 0.1);
  EXPECT_TRUE(track.has_vehicle_size());
}

TEST(Occlusion, ABoxOccludesPositionsBehindItUpToItsHeight) {
  const Aabb box({9, -2, -1}, {10, 2, 1});
  EXPECT_TRUE(occludes(box, {20, 0, 0}));
  EXPECT_TRUE(occludes(box, {20, 3.9, 0.9}));
  EXPECT_FALSE(occludes(box, {20, 4.6, 0}));                          // beside
  EXPECT_FALSE(occludes(box, {20, 0, 1.1}));                          // above
  EXPECT_FALSE(occludes(box, {8, 0, 0}));                             // before
  EXPECT_FALSE(occludes(box, {-20, 0, 0}));                           // on the other side
  EXPECT_FALSE(occludes(Aabb({-1, -1, -1}, {1, 1, 1}), {20, 0, 0}));  // around the sensor
  EXPECT_FALSE(occludes(Aabb(), {20, 0, 0}));
}

TEST(Track, ItsCovarianceIsPositiveDefiniteInEveryFrame) {
  std::mt19937 random(3);
  Pose sensor = Pose::Identity();
  sensor.linear() = Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  Track track;
  track.start(block({0, 10}, 1), sensor);
  for (int i = 0; i < 60; ++i) {
    track.predict(i % 3 == 0 ? 0 : 0.1);
    track.expect(sensor);
    track.correct(block({uniform(random, -0.3, 0.3) + 0.3 * i, 10}, uniform(random, 0.5, 3)), sensor, 0.1);
    for (const bool fixed : {true, false}) {
      const TrackEntry entry = track.entry(sensor, fixed, Eigen::Vector3d::Zero());
      Eigen::Matrix<double, 6, 6> all;
      std::size_t next = 0;
      for (Eigen::Index r = 0; r < 6; ++r)
        for (Eigen::Index c = r; c < 6; ++c)
          all(r, c) = all(c, r) = entry.covariance[next++];
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(all);
      ASSERT_GT(solver.eigenvalues().minCoeff(), 0) << i << ' ' << fixed;
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
