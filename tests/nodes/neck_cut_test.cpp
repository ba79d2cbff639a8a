// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pipeline/refine/neck_cut.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <set>

#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/points/select_points.h"
#include "pcl_bv/synth/rural_road.h"
#include "pipeline/refine/cluster_refiner.h"

namespace pcl_bv {
namespace {

using detail::NeckCut;
using detail::PlanBasins;

struct Cloud {
  std::vector<Eigen::Vector3f> points;
  std::vector<int> owner;  // number of the object of each point

  PointView view() const {
    return PointView::of(points.data()->data(), sizeof(Eigen::Vector3f), points.size());
  }
};

// A person is an upright ellipsoid of 0.5 m x 0.3 m x 1.7 m with arms up to 0.6 m apart.
void add_person(Cloud& cloud, int owner, double x, double y, std::size_t count, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d p;
    for (const int axis : {2, 1, 0})  // not as arguments, whose order depends on the compiler
      p[axis] = normal(random);
    p.normalize();
    p = i % 16 == 0
            ? Eigen::Vector3d(0.06 * p.x() + (p.y() > 0 ? 0.24 : -0.24), 0.06 * p.y(), 0.3 * p.z() + 1.1)
            : Eigen::Vector3d(0.2 * p.x(), 0.15 * p.y(), 0.85 * p.z() + 0.85);
    cloud.points.emplace_back((p + Eigen::Vector3d(x, y, 0)).cast<float>());
    cloud.owner.push_back(owner);
  }
}

void add_box(Cloud& cloud, int owner, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
             std::size_t count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d share;
    for (const int axis : {2, 1, 0})
      share[axis] = unit(random);
    share[static_cast<Eigen::Index>(random() % 3)] = static_cast<double>(random() % 2);  // on a face
    cloud.points.emplace_back((low + share.cwiseProduct(high - low)).cast<float>());
    cloud.owner.push_back(owner);
  }
}

std::size_t cut(const Cloud& cloud, std::vector<std::uint32_t>& parts,
                const Eigen::Vector3d& up = Eigen::Vector3d::UnitZ()) {
  NeckCut neck;
  return neck.find(UsableIsa(Isa::automatic), cloud.view(), up, Eigen::Vector3d::Zero(), 10, parts);
}

// Share of the points whose part has mostly points of their own object.
double share_of_right_points(const Cloud& cloud, const std::vector<std::uint32_t>& parts) {
  std::map<std::uint32_t, std::map<int, std::size_t>> counts;
  for (std::size_t i = 0; i < parts.size(); ++i)
    ++counts[parts[i]][cloud.owner[i]];
  std::size_t right = 0;
  for (const auto& [part, of_owner] : counts) {
    std::size_t most = 0;
    for (const auto& [owner, count] : of_owner)
      most = std::max(most, count);
    right += most;
  }
  return static_cast<double>(right) / static_cast<double>(parts.size());
}

TEST(NeckCut, PartsTwoPeopleWhoseArmsAreEightCentimetresApart) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 50; ++i) {
    Cloud cloud;
    add_person(cloud, 0, 10, 0, 400, random);
    add_person(cloud, 1, 10.7, 0.1 * (i % 5), 300, random);
    std::vector<std::uint32_t> parts;
    ASSERT_EQ(cut(cloud, parts), 2U) << "seed 1, " << i;
    EXPECT_GT(share_of_right_points(cloud, parts), 0.97) << "seed 1, " << i;
  }
}

TEST(NeckCut, LeavesOnePersonAndACarWhole) {
  std::mt19937_64 random(2);
  std::vector<std::uint32_t> parts;
  for (int i = 0; i < 50; ++i) {
    Cloud person, car;
    add_person(person, 0, 12, 3, 500, random);
    EXPECT_LT(cut(person, parts), 2U) << "seed 2, " << i;
    add_box(car, 0, {8, -1, 0.3}, {12.4, 0.8, 0.9}, 1000, random);
    add_box(car, 0, {9.2, -0.8, 0.9}, {11.4, 0.6, 1.5}, 500, random);
    EXPECT_LT(cut(car, parts), 2U) << "seed 2, " << i;
  }
}

TEST(NeckCut, SeparatesAPersonFromAWallAndLeavesTheWallWhole) {
  std::mt19937_64 random(3);
  std::vector<std::uint32_t> parts;
  Cloud cloud;
  add_box(cloud, 0, {5, 5, 0}, {15, 5.2, 2}, 4000, random);
  EXPECT_LT(cut(cloud, parts), 2U);
  add_person(cloud, 1, 10, 4.6, 400, random);
  ASSERT_EQ(cut(cloud, parts), 2U);
  EXPECT_GT(share_of_right_points(cloud, parts), 0.98);
}

TEST(NeckCut, SeparatesAPersonFromACar) {
  std::mt19937_64 random(5);
  std::vector<std::uint32_t> parts;
  for (int i = 0; i < 50; ++i) {
    Cloud cloud;
    add_box(cloud, 0, {8, -1, 0.3}, {12.4, 0.8, 0.9}, 1000, random);
    add_box(cloud, 0, {9.2, -0.8, 0.9}, {11.4, 0.6, 1.5}, 500, random);
    add_person(cloud, 1, 8.5 + 0.07 * i, -1.5, 200, random);
    ASSERT_EQ(cut(cloud, parts), 2U) << "seed 5, " << i;
    EXPECT_GT(share_of_right_points(cloud, parts), 0.97) << "seed 5, " << i;
  }
}

// Grass joins everything that stands in it.
TEST(NeckCut, SeparatesAPersonFromTheGrassAround) {
  std::mt19937_64 random(6);
  std::vector<std::uint32_t> parts;
  Cloud cloud;
  add_person(cloud, 1, 10, 0, 400, random);
  std::uniform_real_distribution<float> along(5, 15), across(-0.7F, 0.7F), height(0, 0.2F);
  for (int i = 0; i < 2000; ++i) {
    cloud.points.emplace_back(along(random), across(random), height(random));
    cloud.owner.push_back(0);
  }
  ASSERT_EQ(cut(cloud, parts), 2U);
  EXPECT_GT(share_of_right_points(cloud, parts), 0.9);  // the grass within 0.3 m is the person's
}

// A kerb leads away from two people.
TEST(NeckCut, SeparatesAGroupFromTheKerbThatLeadsAwayFromIt) {
  std::mt19937_64 random(7);
  std::vector<std::uint32_t> parts;
  Cloud cloud;
  add_person(cloud, 1, 10, 0, 400, random);
  add_person(cloud, 2, 10.7, 0, 400, random);
  for (int i = 0; i < 60; ++i) {
    cloud.points.emplace_back(10.9F + 0.05F * static_cast<float>(i), 0.0F, 0.1F);
    cloud.owner.push_back(0);
  }
  ASSERT_EQ(cut(cloud, parts), 3U);
  EXPECT_GT(share_of_right_points(cloud, parts), 0.98);
}

// The bush is too low for a person, and its centre is 1.8 m from the nearest one.
TEST(NeckCut, SeparatesAGroupFromABushNearby) {
  std::mt19937_64 random(8);
  std::vector<std::uint32_t> parts;
  Cloud cloud;
  add_person(cloud, 1, 10, 0, 400, random);
  add_person(cloud, 2, 10.7, 0, 400, random);
  add_box(cloud, 0, {12.25, -0.25, 0}, {12.75, 0.25, 0.7}, 100, random);
  ASSERT_EQ(cut(cloud, parts), 3U);
  EXPECT_GT(share_of_right_points(cloud, parts), 0.98);
}

TEST(NeckCut, DependsNeitherOnTheOrderOfThePointsNorOnTheDirectionOfUp) {
  std::mt19937_64 random(4);
  Cloud cloud;
  for (int k = 0; k < 3; ++k)
    add_person(cloud, k, 10 + 0.75 * k, 0.2 * k, 300, random);
  std::vector<std::uint32_t> parts, other;
  ASSERT_EQ(cut(cloud, parts), 3U);
  std::vector<std::size_t> order(cloud.points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), random);
  Cloud shuffled;
  for (const std::size_t i : order) {
    shuffled.points.push_back(cloud.points[i]);
    shuffled.owner.push_back(cloud.owner[i]);
  }
  ASSERT_EQ(cut(shuffled, other), 3U);
  for (std::size_t i = 0; i < order.size(); ++i)
    ASSERT_EQ(other[i], parts[order[i]]) << "seed 4, " << i;
  Cloud turned = cloud;
  for (Eigen::Vector3f& point : turned.points)
    point = {point.z(), point.x(), point.y()};
  ASSERT_EQ(cut(turned, other, Eigen::Vector3d::UnitX()), 3U);
  EXPECT_GT(share_of_right_points(turned, other), 0.95);
}

TEST(PlanBasins, OfAllPointsInOneCellAreOneAndFarPointsAreApart) {
  PlanBasins basins;
  std::vector<std::uint32_t> basin_of;
  EXPECT_EQ(basins.find({}, 0.1, basin_of), 0U);
  EXPECT_EQ(basins.find(std::vector<Eigen::Vector2d>(20, {0.05, 0.05}), 0.1, basin_of), 1U);
  EXPECT_EQ(basins.find({{0, 0}, {0.01, 0}, {5, 5}, {-5, 5}}, 0.1, basin_of), 3U);
  EXPECT_EQ(basin_of[0], 0U);  // the densest peak
  EXPECT_EQ(basin_of[1], 0U);
  EXPECT_NE(basin_of[2], basin_of[3]);
}

Frame frame_of(const SynthCloud& cloud) {
  Frame frame;
  frame.points = PointView::of(cloud.xyz.data(), 3 * sizeof(float), cloud.size());
  return frame;
}

// Each point of the clusters without a cut is in exactly one of those with a cut, and enough people are
// apart.
TEST(Refine, CutsGroupsOnARoadAndKeepsEveryPoint) {
  PipelineConfig config;
  config.volumes = {"aabb"};
  FramePipeline off(config);
  config.cluster.refine = Refine::neck;
  FramePipeline neck(config);
  FrameResult whole, parts;
  std::size_t cut = 0;
  for (std::size_t number = 0; number < 3; ++number) {
    const RuralRoadFrame made = make_rural_road_frame({1, 64}, 20 * number);
    const Frame frame = frame_of(made.cloud);
    off.process(frame, whole);
    neck.process(frame, parts);
    EXPECT_TRUE(whole.refinements.empty());
    ASSERT_EQ(parts.refinements.size(), parts.clusters.size());
    EXPECT_EQ(parts.counts.small, whole.counts.small);
    EXPECT_EQ(std::multiset<std::int32_t>(parts.clusters.indices.begin(), parts.clusters.indices.end()),
              std::multiset<std::int32_t>(whole.clusters.indices.begin(), whole.clusters.indices.end()));
    for (std::size_t i = 1; i < parts.clusters.size(); ++i)
      EXPECT_GE(parts.clusters.list_size(i - 1), parts.clusters.list_size(i));
    for (std::size_t i = 0; i < parts.clusters.size(); ++i)
      EXPECT_TRUE(
          std::is_sorted(parts.clusters.list(i), parts.clusters.list(i) + parts.clusters.list_size(i)));
    const auto pieces = static_cast<std::size_t>(
        std::count(parts.refinements.begin(), parts.refinements.end(), Refinement::cut));
    EXPECT_EQ(parts.clusters.size() - pieces + parts.counts.cut, whole.clusters.size());
    EXPECT_GE(pieces, 2 * parts.counts.cut);
    cut += parts.counts.cut;
  }
  EXPECT_GT(cut, 2U);
}

// Two people, of whom the second has 300 points. Where parts need more, the cluster stays whole.
TEST(Refine, MakesNoPartBelowTheMinimumSizeOfItsClass) {
  std::mt19937_64 random(9);
  Cloud cloud;
  add_person(cloud, 0, 10, 0, 400, random);
  add_person(cloud, 1, 10.7, 0, 300, random);
  Frame frame;
  frame.points = cloud.view();
  frame.classes = std::make_shared<std::vector<std::int64_t>>(cloud.points.size(), 7);
  PipelineConfig config;
  config.volumes = {"aabb"};
  config.cluster.class_field = FieldName{"class"};
  config.cluster.refine = Refine::neck;
  for (const std::size_t min_size : {20, 350}) {
    config.cluster.classes = {{.value = 7, .min_size = min_size}};
    FrameResult result;
    FramePipeline(config).process(frame, result);
    EXPECT_EQ(result.clusters.size(), min_size == 20 ? 2U : 1U);
    EXPECT_EQ(result.class_of, std::vector<std::int64_t>(result.clusters.size(), 7));
  }
}

}  // namespace
}  // namespace pcl_bv
