// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A tree of volumes answers as if each volume had been asked.

#include "pcl_bv/trees/volume_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "clouds.h"
#include "executions.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/volumes/pair_queries.h"
#include "scattered_volumes.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;
using Volumes = std::vector<AnyVolume>;
using Indices = std::vector<std::int32_t>;

template <typename Holds>
Indices indices_where(const Volumes& volumes, const Holds& holds) {
  Indices indices;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    if (holds(volumes[i])) indices.push_back(static_cast<std::int32_t>(i));
  }
  return indices;
}

void expect_contains(const VolumeTree& tree, const Volumes& volumes, const Vector3d& point) {
  const Indices expected = indices_where(volumes, [&](const AnyVolume& v) { return contains(v, point); });
  Indices found = {-7};
  tree.all_containing(point, found);
  ASSERT_EQ(found, expected) << point.transpose();
  ASSERT_EQ(tree.any_containing(point), !expected.empty()) << point.transpose();
}

void expect_hits(const VolumeTree& tree, const Volumes& volumes, const Ray& ray) {
  std::vector<VolumeHit> expected, found;
  std::optional<VolumeHit> first;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const auto interval = intersect(volumes[i], ray.origin, ray.direction);
    if (!interval) continue;
    expected.push_back({static_cast<std::int32_t>(i), *interval});
    if (!first || interval->enter < first->interval.enter) first = expected.back();
  }
  tree.all_hit(ray.origin, ray.direction, found);
  ASSERT_EQ(found.size(), expected.size()) << ray.origin.transpose() << " to " << ray.direction.transpose();
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(found[i].index, expected[i].index);
    ASSERT_EQ(found[i].interval.enter, expected[i].interval.enter);
    ASSERT_EQ(found[i].interval.exit, expected[i].interval.exit);
  }
  const auto hit = tree.first_hit(ray.origin, ray.direction);
  ASSERT_EQ(hit.has_value(), first.has_value());
  if (!hit) return;
  ASSERT_EQ(hit->index, first->index) << ray.origin.transpose() << " to " << ray.direction.transpose();
  ASSERT_EQ(hit->interval.enter, first->interval.enter);
  ASSERT_EQ(hit->interval.exit, first->interval.exit);
}

void expect_nearest(const VolumeTree& tree, const Volumes& volumes, const Vector3d& point, double limit) {
  std::optional<VolumeDistance> expected;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    if (empty(volumes[i])) continue;
    const double d = distance(volumes[i], point);
    if (d <= limit && (!expected || d < expected->distance)) expected = {static_cast<std::int32_t>(i), d};
  }
  const auto found = tree.nearest(point, limit);
  ASSERT_EQ(found.has_value(), expected.has_value()) << point.transpose();
  if (!found) return;
  ASSERT_EQ(found->index, expected->index) << point.transpose();
  ASSERT_EQ(found->distance, expected->distance) << point.transpose();
}

void expect_meets(const VolumeTree& tree, const Volumes& volumes, const AnyVolume& volume) {
  Indices found;
  tree.all_overlapping(volume, found);
  ASSERT_EQ(found, indices_where(volumes, [&](const AnyVolume& v) { return overlaps(v, volume); }))
      << shape_name(volume);
  const Aabb box = aabb(volume);
  tree.all_with_box_overlapping(box, found);
  ASSERT_EQ(found, indices_where(volumes, [&](const AnyVolume& v) { return aabb(v).overlaps(box); }));
}

// From about a volume and from afar to near another one's surface, and along the axes.
std::vector<Ray> rays_about(Random& random, const Volumes& volumes, std::size_t count) {
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const auto any = [&]() -> const AnyVolume& {
      const auto i = static_cast<std::size_t>(random.uniform(0, 1) * static_cast<double>(volumes.size()));
      return volumes[std::min(i, volumes.size() - 1)];
    };
    const AnyVolume &from = any(), &to = any();
    if (empty(from) || empty(to)) continue;
    const Vector3d origin = support(from, random.vector(1)), target = support(to, random.vector(1));
    const Vector3d afar = target + 1000 * random.uniform(0, 1) * (origin - target);
    rays.push_back({origin, target - origin});
    rays.push_back({afar, target - afar});
    rays.push_back({origin, Vector3d::Unit(static_cast<int>(rays.size() % 3))});
    rays.push_back({origin, Vector3d::Zero()});
  }
  return rays;
}

// All questions, at places where the answers are close.
void expect_as_one_by_one(const VolumeTree& tree, const Volumes& volumes, Random& random) {
  for (std::size_t i = 0; i < volumes.size(); i += 1 + volumes.size() / 8) {
    const AnyVolume& volume = volumes[i];
    if (empty(volume) || aabb(volume).empty()) continue;
    for (const Vector3d& p :
         points_about(random, volume, 0.01 * norm3(Vector3d(aabb(volume).max() - aabb(volume).min())), 2)) {
      expect_contains(tree, volumes, p);
      expect_nearest(tree, volumes, p, kInfinity);
    }
    expect_nearest(tree, volumes, 3 * center(volume), 0.5 * norm3(center(volume)));
    expect_meets(tree, volumes, volume);
  }
  for (const Ray& ray : rays_about(random, volumes, 40))
    expect_hits(tree, volumes, ray);
}

void expect_answers(std::size_t count, double spread, const std::vector<Scale>& of_scales) {
  Random random(21);
  for (const Scale& scale : of_scales) {
    const Volumes volumes = scattered_volumes(random, scale, count, spread);
    SCOPED_TRACE(scale.name);
    const VolumeTree tree(volumes);
    ASSERT_NO_FATAL_FAILURE(expect_as_one_by_one(tree, volumes, random));
  }
}

TEST(VolumeTree, OfAFewAnswersAsIfEveryVolumeWereAsked) {
  expect_answers(1, 1, scales());
}
TEST(VolumeTree, OfSomeAnswersAsIfEveryVolumeWereAsked) {
  expect_answers(60, 20, scales());
}
TEST(VolumeTree, OfManyAnswersAsIfEveryVolumeWereAsked) {
  expect_answers(test::kFewCases ? 100 : 500, 30, {scales()[0], scales()[2]});
}

TEST(VolumeTree, AsksVolumesThatNoBoxHoldsAndNeverFindsEmptyOnes) {
  Random random(22);
  Volumes volumes = scattered_volumes(random, scales()[0], 100, 20);
  for (const AnyVolume& odd : odd_volumes(1))
    volumes.insert(volumes.begin() + static_cast<std::ptrdiff_t>(volumes.size() / 2), odd);
  const VolumeTree tree(volumes);
  ASSERT_NO_FATAL_FAILURE(expect_as_one_by_one(tree, volumes, random));
  for (const AnyVolume& odd : odd_volumes(1))
    ASSERT_NO_FATAL_FAILURE(expect_meets(tree, volumes, odd));
}

TEST(VolumeTree, TakesPlacesAndRaysOfAnyNumbers) {
  Random random(23);
  Volumes volumes = scattered_volumes(random, scales()[0], 60, 20);
  const Vector3d far = Vector3d::Constant(1e300);
  volumes.insert(volumes.begin(), {Aabb(-far, far), Sphere(), Sphere({1e99, 0, 0}, 1e98)});
  const double numbers[] = {0, 1, -3e7, 1e99, -1e120, 1e200, 1e-300, kInfinity, kNan};
  const VolumeTree tree(volumes);
  for (const double x : numbers) {
    for (const double y : numbers) {
      const Vector3d place(x, y, 0.5);
      ASSERT_NO_FATAL_FAILURE(expect_contains(tree, volumes, place));
      ASSERT_NO_FATAL_FAILURE(expect_nearest(tree, volumes, place, kInfinity));
      ASSERT_NO_FATAL_FAILURE(expect_hits(tree, volumes, {place, {-x, 1, 0}}));
      ASSERT_NO_FATAL_FAILURE(expect_hits(tree, volumes, {{5, 5, 5}, {x, y, -5}}));
      ASSERT_NO_FATAL_FAILURE(expect_hits(tree, volumes, {{9, 0.1, 0.1}, Vector3d(-1, 1e-3, 0) * x}));
    }
  }
  for (const double tiny : {1e-308, 1e-320, 1e300, 1e308})
    ASSERT_NO_FATAL_FAILURE(expect_hits(tree, volumes, {{9, 0.1, 0.1}, Vector3d(-1, 0.01, 0.02) * tiny}));
}

TEST(VolumeTree, GivesTheFirstOfEqualVolumes) {
  Volumes volumes(100, AnyVolume(Sphere({1, 2, 3}, 0.5)));
  volumes[0] = Sphere({9, 9, 9}, 0.1);
  const VolumeTree tree(volumes);
  EXPECT_EQ(tree.first_hit({-4, 2, 3}, {1, 0, 0})->index, 1);
  EXPECT_EQ(tree.nearest({4, 2, 3})->index, 1);
  EXPECT_EQ(tree.nearest({1, 2, 3})->index, 1);
  Indices found;
  tree.all_containing({1, 2, 3}, found);
  EXPECT_EQ(found.size(), 99U);
}

TEST(VolumeTree, AnswersForVolumesThatMovedAfterRefit) {
  Random random(24);
  const Volumes before = scattered_volumes(random, scales()[0], 300, 20);
  Volumes after = scattered_volumes(random, scales()[0], 300, 30);
  after.resize(before.size(), Sphere());
  std::rotate(after.begin(), after.begin() + 11, after.end());
  after[3] = odd_volumes(1)[1];
  VolumeTree tree(before);
  const VolumeTree kept = tree;
  tree.refit(after);
  ASSERT_NO_FATAL_FAILURE(expect_as_one_by_one(tree, after, random));
  ASSERT_NO_FATAL_FAILURE(expect_as_one_by_one(kept, before, random));
  tree.refit(before);
  ASSERT_NO_FATAL_FAILURE(expect_as_one_by_one(tree, before, random));
  EXPECT_THROW(tree.refit(Volumes(3)), std::invalid_argument);
  EXPECT_EQ(tree.size(), before.size());
}

TEST(VolumeTree, LabelsPointsAndFindsHitsTheSameForEveryExecution) {
  Random random(25);
  const Volumes volumes = scattered_volumes(random, scales()[0], 200, 5);
  auto cloud = test::gaussian<float>(2 * kChunkPoints + 77, 25, 3);
  cloud.xyz[7] = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Ray> rays = rays_about(random, volumes, 700);
  const VolumeTree serial(volumes);
  Indices expected;
  serial.first_containing(cloud.view(), expected);
  std::size_t labelled = 0;
  for (std::size_t i = 0; i < cloud.size(); i += 101) {
    const Coordinates p = load_point(cloud.view(), i);
    const Indices all = indices_where(volumes, [&](const AnyVolume& v) {
      return contains(v, {p.x, p.y, p.z});
    });
    ASSERT_EQ(expected[i], all.empty() ? -1 : all.front());
    labelled += !all.empty();
  }
  EXPECT_GT(labelled, 50U);
  for (const auto& [name, execution] : test::every_execution()) {
    const VolumeTree tree(volumes, execution);
    Indices labels;
    tree.first_containing(cloud.view(), labels, execution);
    ASSERT_EQ(labels, expected) << name;
    std::vector<VolumeHit> hits;
    tree.first_hits(rays, hits, execution);
    ASSERT_EQ(hits.size(), rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto hit = serial.first_hit(rays[i].origin, rays[i].direction);
      ASSERT_EQ(hits[i].index, hit ? hit->index : -1) << name;
      if (!hit) continue;
      ASSERT_EQ(hits[i].interval.enter, hit->interval.enter) << name;
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
