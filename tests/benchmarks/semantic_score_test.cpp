// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scores next to SemanticKITTI's labels: points and partitions whose scores are computed by hand.

#include "semantic_score.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pcl_bv::bench {
namespace {

constexpr std::uint32_t kRoad = 40, kCar = 10, kVegetation = 70, kUnlabelled = 0, kOutlier = 1, kTerrain = 72;

using Labels = std::vector<std::uint32_t>;

TEST(SemanticScore, GroundIsCountedUnderEachProtocolForVegetation) {
  // road found, road missed, car found as ground, car, low vegetation found, low vegetation, high vegetation
  // found
  const Labels labels{kRoad, kRoad, kCar, kCar, kVegetation, kVegetation, kVegetation};
  const std::vector<float> z{-1.7F, -1.7F, -1, -1, -1.5F, -1.5F, 0.5F};
  const std::vector<std::uint8_t> found{1, 0, 1, 0, 1, 0, 1};
  const GroundCounts low = count_ground(labels, z, found, Vegetation::ground, -1.2975);
  EXPECT_EQ(low.true_positive, 2U);   // road, low vegetation
  EXPECT_EQ(low.false_negative, 2U);  // road, low vegetation
  EXPECT_EQ(low.false_positive, 2U);  // car, high vegetation
  EXPECT_EQ(low.true_negative, 1U);
  EXPECT_DOUBLE_EQ(low.precision(), 0.5);
  EXPECT_DOUBLE_EQ(low.recall(), 0.5);
  EXPECT_DOUBLE_EQ(low.f1(), 0.5);
  EXPECT_DOUBLE_EQ(low.accuracy(), 3.0 / 7);
  const GroundCounts without = count_ground(labels, z, found, Vegetation::not_counted, -1.2975);
  EXPECT_EQ(without.true_positive, 1U);
  EXPECT_EQ(without.false_positive, 1U);
  EXPECT_EQ(without.true_negative, 1U);
  EXPECT_EQ(without.false_negative, 1U);
  const GroundCounts none = count_ground(labels, z, found, Vegetation::no_ground, -1.2975);
  EXPECT_EQ(none.true_positive, 1U);
  EXPECT_EQ(none.false_positive, 3U);
  EXPECT_EQ(none.true_negative, 2U);
}

TEST(SemanticScore, TheUpperHalfOfALabelIsNoClassAndUnlabelledPointsDoNotCount) {
  const Labels labels{kRoad | 7U << 16, kUnlabelled, kOutlier, kTerrain};
  const std::vector<float> z(4, 0);
  const std::vector<std::uint8_t> found{1, 1, 0, 1};
  const GroundCounts counts = count_ground(labels, z, found, Vegetation::ground, -1);
  EXPECT_EQ(counts.true_positive, 2U);
  EXPECT_EQ(counts.false_positive + counts.true_negative + counts.false_negative, 0U);
  EXPECT_DOUBLE_EQ(counts.precision(), 1);
}

TEST(SemanticScore, EqualPartitionsHaveNoEntropy) {
  const SegmentEntropy entropy = segment_entropy(Labels{1, 1, 2, 2, 0, 0}, Labels{9, 9, 4, 4, 0, 0});
  EXPECT_EQ(entropy.under, 0);
  EXPECT_EQ(entropy.over, 0);
}

TEST(SemanticScore, ASplitObjectIsOverSegmented) {
  // object 1 in halves: ln 2; object 2 in a third and two thirds
  const SegmentEntropy entropy = segment_entropy(Labels{1, 1, 1, 1, 2, 2, 2}, Labels{5, 5, 6, 6, 7, 8, 8});
  const double third = 1.0 / 3;
  EXPECT_NEAR(entropy.over, std::log(2) - third * std::log(third) - 2 * third * std::log(2 * third), 1e-12);
  EXPECT_EQ(entropy.under, 0);
}

TEST(SemanticScore, AMergedClusterIsUnderSegmented) {
  const SegmentEntropy entropy = segment_entropy(Labels{1, 1, 2, 2}, Labels{5, 5, 5, 5});
  EXPECT_NEAR(entropy.under, std::log(2), 1e-12);
  EXPECT_EQ(entropy.over, 0);
}

TEST(SemanticScore, PointsWithoutAClusterArePartOfTheOverSegmentation) {
  EXPECT_NEAR(segment_entropy(Labels{1, 1, 1, 1}, Labels{5, 5, 0, 0}).over, std::log(2), 1e-12);
}

TEST(SemanticScore, ClustersOfOnlyGroundOrUnlabelledPointsDoNotCount) {
  EXPECT_EQ(segment_entropy(Labels{0, 0, 1}, Labels{5, 5, 6}).under, 0);
  EXPECT_NEAR(segment_entropy(Labels{0, 1}, Labels{5, 5}).under, std::log(2), 1e-12);
}

TEST(SemanticScore, TrueSegmentsAreClustersOfOneClassAndInstance) {
  std::vector<float> xyz;
  Labels labels;
  const auto add_row = [&](float x, std::size_t points, std::uint32_t label) {
    for (std::size_t i = 0; i < points; ++i) {
      xyz.insert(xyz.end(), {x, 0.5F * static_cast<float>(i), 0});
      labels.push_back(label);
    }
  };
  add_row(0, 12, kCar | 1U << 16);
  add_row(0.5F, 10, kCar | 2U << 16);  // near, but another instance
  add_row(1, 10, kRoad);
  add_row(1.5F, 9, kVegetation);  // too few points
  add_row(30, 10, kVegetation);
  add_row(40, 10, kVegetation);  // the same label, but far away
  const PointView points = PointView::of(xyz.data(), 12, labels.size());
  const Labels segments = true_segments(points, labels);
  EXPECT_EQ(segments[0], 1U);
  EXPECT_EQ(segments[11], 1U);
  EXPECT_EQ(segments[12], 2U);
  EXPECT_EQ(segments[22], 0U);  // road
  EXPECT_EQ(segments[32], 0U);
  EXPECT_NE(segments[41], 0U);
  EXPECT_NE(segments[51], 0U);
  EXPECT_NE(segments[41], segments[51]);
}

TEST(SemanticScore, SweepsAreAveraged) {
  SweepMean mean;
  mean.add(1);
  mean.add(3);
  EXPECT_EQ(mean.sweeps(), 2U);
  EXPECT_EQ(mean.mean(), 2);
  EXPECT_EQ(mean.deviation(), 1);
  EXPECT_EQ(SweepMean().deviation(), 0);
}

}  // namespace
}  // namespace pcl_bv::bench
