// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Neighbours are those that looking at every point finds, in every way that PCL asks for them.
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include "clouds.h"
#include "flush_to_zero.h"
#include "neighbours.h"
#include "pcl_bv/points/isa.h"

struct RadarPoint {  // that PCL has never seen
  float doppler;
  float x, y, z;
};

struct SurveyPoint {
  double x, y, z;
};

namespace pcl_bv::detail {
namespace {

using namespace test;
using Tree = PointTreeSearch<pcl::PointXYZ>;

std::vector<pcl::PointXYZ> places_about(const PointsXyz& cloud) {
  std::vector<pcl::PointXYZ> places;
  for (std::size_t i = 0; i < cloud.size(); i += cloud.size() / 7 + 1) {
    pcl::PointXYZ p = cloud[i];
    if (!pcl::isFinite(p)) continue;
    places.push_back(p);
    p.x += 0.1F * std::abs(p.y), p.z -= 0.05F * std::abs(p.x);
    places.push_back(p);
  }
  places.push_back({0, 0, 0});
  return places;
}

// All radii about the places that are or lie between distances.
void expect_brute_force(const Tree& tree, const PointsXyz& cloud, const pcl::Indices* indices) {
  for (const pcl::PointXYZ& place : places_about(cloud)) {
    const std::vector<Neighbor> all = by_distance(cloud, indices, place);
    for (const std::size_t k : {std::size_t{1}, std::size_t{10}, all.size(), all.size() + 3})
      EXPECT_EQ(nearest(tree, place, static_cast<int>(k)), first_of(all, k));
    for (const std::size_t rank : {std::size_t{0}, all.size() / 20, all.size() / 2, all.size() - 1}) {
      if (rank >= all.size()) continue;
      const double radius = std::sqrt(all[rank].squared_distance);
      for (const double r : {radius, 1.01 * radius, std::numeric_limits<double>::infinity()}) {
        EXPECT_EQ(within(tree, place, r), first_of(all, all.size(), r));
        for (const unsigned most :
             {1U, 5U, static_cast<unsigned>(all.size()), std::numeric_limits<unsigned>::max()})
          EXPECT_EQ(within(tree, place, r, most), first_of(all, most, r));
      }
    }
  }
}

TEST(PointTreeSearch, FindsWhatLookingAtEveryPointFinds) {
  for (const TestCloud<float>& made : nasty_clouds<float>()) {
    SCOPED_TRACE(made.name);
    const PointsXyz::Ptr cloud = points_of(made.xyz);
    Tree tree;
    tree.setInputCloud(cloud);
    expect_brute_force(tree, *cloud, nullptr);
    const pcl::IndicesPtr third = every(3, cloud->size());
    tree.setInputCloud(cloud, third);
    expect_brute_force(tree, *cloud, third.get());
  }
}

TEST(PointTreeSearch, LeavesOutPointsAtExactlyTheRadius) {
  Tree tree;
  tree.setInputCloud(points_of({0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0}));
  const pcl::PointXYZ origin(0, 0, 0);
  EXPECT_EQ(within(tree, origin, 1).indices, pcl::Indices({0}));
  EXPECT_EQ(within(tree, origin, 1, 2).indices, pcl::Indices({0}));
  EXPECT_EQ(within(tree, origin, 1.0000001).indices, pcl::Indices({0, 1, 2}));
}

TEST(PointTreeSearch, SortsOnlyWhereItIsAskedTo) {
  const PointsXyz::Ptr cloud = uniform(3000, 1, 5);
  Tree sorted, unsorted(false);
  EXPECT_TRUE(sorted.getSortedResults());
  EXPECT_FALSE(unsorted.getSortedResults());
  sorted.setInputCloud(cloud);
  unsorted.setInputCloud(cloud);
  const Answer in_order = within(sorted, cloud->front(), 0.5),
               in_none = within(unsorted, cloud->front(), 0.5);
  ASSERT_GT(in_order.count, 100);
  EXPECT_TRUE(std::is_sorted(in_order.squares.begin(), in_order.squares.end()));
  EXPECT_FALSE(std::is_sorted(in_none.squares.begin(), in_none.squares.end()));
  EXPECT_EQ(std::set<int>(in_order.indices.begin(), in_order.indices.end()),
            std::set<int>(in_none.indices.begin(), in_none.indices.end()));
  EXPECT_EQ(nearest(unsorted, cloud->front(), 50), nearest(sorted, cloud->front(), 50));
  unsorted.setSortedResults(true);
  EXPECT_EQ(within(unsorted, cloud->front(), 0.5), in_order);
}

TEST(PointTreeSearch, AnswersByIndexAndForManyAsByPlace) {
  const PointsXyz::Ptr cloud = uniform(500, 1, 6), other = uniform(20, 1, 7);
  Tree tree;
  for (const pcl::IndicesPtr& list : {pcl::IndicesPtr(), every(7, cloud->size())}) {
    tree.setInputCloud(cloud, list);
    EXPECT_EQ(tree.getInputCloud(), cloud);
    EXPECT_EQ(tree.getIndices(), list);
    const pcl::PointXYZ place = (*cloud)[list ? 7 * 4 : 4];
    EXPECT_EQ(nearest(tree, 4, 10), nearest(tree, place, 10));
    EXPECT_EQ(nearest(tree, *other, 4, 10), nearest(tree, (*other)[4], 10));
    EXPECT_EQ(within(tree, 4, 0.3, 6), within(tree, place, 0.3, 6));
    Answer of_other;
    of_other.count = tree.radiusSearch(*other, 4, 0.3, of_other.indices, of_other.squares, 6);
    EXPECT_EQ(of_other, within(tree, (*other)[4], 0.3, 6));

    std::vector<pcl::Indices> indices;
    std::vector<std::vector<float>> squares;
    tree.nearestKSearch(*other, {}, 3, indices, squares);
    ASSERT_EQ(indices.size(), other->size());
    EXPECT_EQ(indices[19], nearest(tree, (*other)[19], 3).indices);
    tree.radiusSearch(*other, {5, 2}, 0.3, indices, squares, 4);
    ASSERT_EQ(squares.size(), 2U);
    EXPECT_EQ(squares[1], within(tree, (*other)[2], 0.3, 4).squares);
    pcl::PointXYZI same;
    same.getVector3fMap() = place.getVector3fMap();
    Answer of_type;
    of_type.count = tree.nearestKSearchT(same, 10, of_type.indices, of_type.squares);
    EXPECT_EQ(of_type, nearest(tree, place, 10));
  }
}

TEST(PointTreeSearch, HasNoNeighboursForWhatPclAssertsAgainst) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const PointsXyz::Ptr cloud = uniform(100, 1, 8);
  Tree tree;
  EXPECT_EQ(nearest(tree, cloud->front(), 3), Answer());
  EXPECT_EQ(nearest(tree, 0, 3), Answer());
  EXPECT_EQ(within(tree, 0, 1), Answer());
  tree.setInputCloud(cloud);
  for (const pcl::PointXYZ& place : {pcl::PointXYZ(nan, 0, 0), pcl::PointXYZ(0, inf, 0)}) {
    EXPECT_EQ(nearest(tree, place, 3), Answer());
    EXPECT_EQ(within(tree, place, 1), Answer());
  }
  for (const int k : {0, -1, std::numeric_limits<int>::min()})
    EXPECT_EQ(nearest(tree, cloud->front(), k), Answer());
  for (const double radius : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(within(tree, cloud->front(), radius), Answer());
  for (const int index : {-1, 100, std::numeric_limits<int>::max()}) {
    EXPECT_EQ(nearest(tree, index, 3), Answer());
    EXPECT_EQ(nearest(tree, *cloud, index, 3), Answer());
    EXPECT_EQ(within(tree, index, 1), Answer());
  }
  tree.setInputCloud(cloud, every(10, 100));
  EXPECT_EQ(nearest(tree, 10, 3), Answer());
  EXPECT_EQ(nearest(tree, 9, 3).count, 3);
  tree.setInputCloud(nullptr);
  EXPECT_EQ(nearest(tree, cloud->front(), 3), Answer());
}

TEST(PointTreeSearch, AnswersTheSameInAHostThatHasSwitchedDenormalsOff) {
  const PointsXyz::Ptr cloud = points_of(gaussian<float>(200, 3, 1e-41).xyz);
  Tree tree;
  tree.setInputCloud(cloud);
  const Answer expected = nearest(tree, 5, 20), expected_near = within(tree, 5, 1e-41);
  EXPECT_GT(expected_near.count, 5);
  Answer found, found_near;
  {
    const FlushToZero host;
    tree.setInputCloud(cloud);
    found = nearest(tree, 5, 20);
    found_near = within(tree, 5, 1e-41);
  }
  EXPECT_EQ(found, expected);
  EXPECT_EQ(found_near, expected_near);
}

TEST(PointTreeSearch, KeepsItsCloudWhenAnIndexIsOutside) {
  const PointsXyz::Ptr cloud = uniform(100, 1, 9);
  Tree tree;
  tree.setInputCloud(cloud);
  const Answer before = nearest(tree, 5, 4);
  EXPECT_THROW(tree.setInputCloud(uniform(10, 1, 1), every(9, 100)), std::out_of_range);
  EXPECT_EQ(tree.getInputCloud(), cloud);
  EXPECT_EQ(nearest(tree, 5, 4), before);
}

TEST(PointTreeSearch, AnswersTheSameOnEveryInstructionSetAndNumberOfThreads) {
  const PointsXyz::Ptr cloud = street(16'000);
  Tree reference;
  reference.setInstructionSet(Isa::scalar);
  reference.setInputCloud(cloud);
  for (const Isa isa : usable_isas()) {
    for (const unsigned threads : {1U, 2U, 3U}) {
      Tree tree;
      tree.setInstructionSet(isa);
      tree.setNumberOfThreads(threads);
      tree.setInputCloud(cloud);
      for (int i = 0; i < 500; ++i) {
        ASSERT_EQ(nearest(tree, 17 * i, 8), nearest(reference, 17 * i, 8));
        ASSERT_EQ(within(tree, 17 * i, 0.5), within(reference, 17 * i, 0.5));
      }
    }
  }
}

TEST(PointTreeSearch, IsSharedByThreadsThatAskIt) {
  const PointsXyz::Ptr cloud = uniform(20'000, 5, 10);
  Tree tree;
  tree.setInputCloud(cloud);
  std::vector<Answer> expected;
  for (int i = 0; i < 400; ++i)
    expected.push_back(within(tree, 41 * i, 0.7));
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    threads.emplace_back([&, t] {  // for long enough that they meet: a tenth of a second
      for (int i = 0; i < 20'000; ++i) {
        const int j = (i + 100 * static_cast<int>(t)) % 400;
        wrong[t] += !(within(tree, 41 * j, 0.7) == expected[static_cast<std::size_t>(j)]);
        wrong[t] += nearest(tree, 41 * j, 3).count != 3;
      }
    });
  }
  for (std::thread& thread : threads)
    thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

TEST(PointTreeSearch, TakesPointTypesThatPclHasNeverSeen) {
  const pcl::PointCloud<RadarPoint>::Ptr radar(new pcl::PointCloud<RadarPoint>);
  const pcl::PointCloud<SurveyPoint>::Ptr survey(new pcl::PointCloud<SurveyPoint>);
  for (int i = 0; i < 100; ++i) {
    radar->push_back({5, static_cast<float>(i), 0, 0});
    survey->push_back({5e6 + 1e-6 * i, 4e5, 100});  // no two would differ as floats
  }
  PointTreeSearch<RadarPoint> near_radar;
  near_radar.setInputCloud(radar);
  EXPECT_EQ(within(near_radar, 50, 1.5).indices, pcl::Indices({50, 49, 51}));
  PointTreeSearch<SurveyPoint> near_survey;
  near_survey.setInputCloud(survey);
  EXPECT_EQ(within(near_survey, 50, 1.5e-6).indices.front(), 50);
  EXPECT_EQ(within(near_survey, 50, 1.5e-6).count, 3);
  EXPECT_EQ(near_survey.getPointTree().size(), 100U);
}

}  // namespace
}  // namespace pcl_bv::detail
