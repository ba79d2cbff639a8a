// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/trees/collision.h"

#include <gtest/gtest.h>

#include <set>

#include "any_volumes.h"
#include "clouds.h"
#include "pcl_bv/volumes/pair_queries.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;

bool holds(const AnyVolume& volume, const ExactPoint& p) {
  return std::visit([&](const auto& shape) { return !shape.empty() && inside(shape, p); }, volume);
}

template <typename T>
Vector3d point_of(const test::TestCloud<T>& cloud, std::size_t i) {
  const Coordinates p = load_point(cloud.view(), i);
  return {p.x, p.y, p.z};
}

// The least squared distance of a point of one cloud from the image of a point of the other.
template <typename T>
test::Rational nearest_square(const test::TestCloud<T>& points, const test::TestCloud<T>& others,
                              const Eigen::Isometry3d& pose) {
  test::Rational least = -1;
  for (std::size_t j = 0; j < others.size(); ++j) {
    const ExactPoint moved = image(pose, exact(point_of(others, j)));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const test::Rational square = squared_distance(exact(point_of(points, i)), moved);
      if (least < 0 || square < least) least = square;
    }
  }
  return least;
}

template <typename T>
class CloudsWithin : public ::testing::Test {};
using ScalarTypes = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CloudsWithin, ScalarTypes);

// The margin is the exact distance of the two clouds, rounded down and up, and a little less: errs only
// towards true, and not by 1e-9.
TYPED_TEST(CloudsWithin, IsDecidedAtTheExactDistance) {
  for (const double scale : {1e-20, 1e-3, 1.0, 1e4, 1e15}) {
    Random random(1);
    for (int round = 0; round < 8; ++round) {
      const auto seed = static_cast<std::uint64_t>(10 * round);
      const auto points = test::gaussian<TypeParam>(60, seed, scale),
                 others = test::gaussian<TypeParam>(50, seed + 1, scale);
      Eigen::Isometry3d pose = random.isometry(scale);
      pose.translation() += Vector3d(4 * scale, 0, 0);
      const PointTree tree(points.view()), moving(others.view());
      const test::Rational square = nearest_square(points, others, pose);
      double distance = std::sqrt(static_cast<double>(square));
      while (test::Rational(distance) * test::Rational(distance) < square)
        distance = std::nextafter(distance, kInfinity);
      EXPECT_TRUE(within(tree, moving, pose, distance)) << scale << ", " << round;
      EXPECT_TRUE(within(tree, moving, pose, 1.5 * distance));
      EXPECT_FALSE(within(tree, moving, pose, distance * (1 - 1e-9)));
      EXPECT_FALSE(within(tree, moving, pose, 0));
    }
  }
}

TEST(CloudsWithin, TouchWhereAPointOfOneIsMovedOntoAPointOfTheOther) {
  const auto points = test::gaussian<float>(3000, 3);
  const PointTree tree(points.view());
  for (int round = 0; round < 50; ++round) {
    const auto other = test::gaussian<float>(1, 4 + static_cast<std::uint64_t>(round));
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = point_of(points, static_cast<std::size_t>(round * 50)) - point_of(other, 0);
    EXPECT_TRUE(within(tree, PointTree(other.view()), pose));
    pose.translation().x() += 1e-3;
    EXPECT_EQ(within(tree, PointTree(other.view()), pose), nearest_square(points, other, pose) == 0);
  }
  EXPECT_FALSE(within(tree, PointTree(), Eigen::Isometry3d::Identity(), 1e90));
  EXPECT_FALSE(within(PointTree(), tree, Eigen::Isometry3d::Identity(), 1e90));
}

// Points on the surfaces of volumes that have moved.
TEST(VolumesWithin, MissNoPointThatIsInsideByExactArithmetic) {
  Random random(5);
  for (const Scale& scale : scales()) {
    if (scale.extent < 1e-30 || scale.extent > 1e30) continue;  // transformed() multiplies
    std::size_t held = 0;
    const std::vector<AnyVolume> volumes = volumes_of_every_kind(random, scale);
    const MovingVolumes moving(volumes);
    const Eigen::Isometry3d pose = random.isometry(scale.extent);
    for (std::size_t v = 0; v < volumes.size(); ++v) {
      for (const Vector3d& p : points_about(random, volumes[v], 1e-3 * scale.extent, 6)) {
        const Vector3d place = pose * p;
        const ExactPoint moved_back = image(pose.inverse(), exact(place));
        const PointTree tree(PointView::of(place.data(), 24, 1));
        std::vector<std::int32_t> touched;
        list_within(tree, moving, pose, 0, touched);
        EXPECT_EQ(within(tree, moving, pose), !touched.empty());
        // The image of p itself is inside where p is; `place` is that but for rounding.
        if (!holds(volumes[v], exact(p)) || !holds(volumes[v], moved_back)) continue;
        const test::Rational off = squared_distance(image(pose, exact(p)), exact(place));
        if (off != 0) {
          list_within(tree, moving, pose, std::sqrt(static_cast<double>(off)) * (1 + 1e-10), touched);
        }
        ++held;
        ASSERT_TRUE(std::binary_search(touched.begin(), touched.end(), static_cast<std::int32_t>(v)))
            << shape_name(volumes[v]) << ", " << scale.name;
      }
    }
    EXPECT_GT(held, 20U) << scale.name;
  }
}

TEST(VolumesWithin, AreThoseWhoseDistanceSaysSo) {
  Random random(6);
  const Scale unit{"unit", 0, 1};
  const auto cloud = test::gaussian<double>(400, 7);
  const PointTree tree(cloud.view());
  std::size_t some = 0;
  for (int round = 0; round < 20; ++round) {
    const std::vector<AnyVolume> volumes = volumes_of_every_kind(random, unit);
    const MovingVolumes moving(volumes);
    Eigen::Isometry3d pose = random.isometry(1);
    pose.translation() += random.vector(3);
    for (const double margin : {0.0, 0.03, 0.3}) {
      std::vector<std::int32_t> touched;
      list_within(tree, moving, pose, margin, touched);
      const std::set<std::int32_t> found(touched.begin(), touched.end());
      for (std::size_t v = 0; v < volumes.size(); ++v) {
        const ConvexBody body = ConvexBody(volumes[v]).transformed(pose);
        double least = kInfinity;
        for (std::size_t i = 0; i < cloud.size(); ++i)
          least = std::min(least, distance(body, point_of(cloud, i)));
        if (std::abs(least - margin) < 1e-9 && least > 0) continue;  // either is right
        ASSERT_EQ(found.count(static_cast<std::int32_t>(v)) != 0, least <= margin)
            << shape_name(volumes[v]) << ", " << margin << ", " << least;
        some += least <= margin;
      }
    }
  }
  EXPECT_GT(some, 30U);
}

TEST(VolumesWithin, OfTwoListsAreThePairsWhoseBodiesSaySo) {
  Random random(8);
  const Scale unit{"unit", 0, 1};
  std::vector<AnyVolume> first, second;
  for (int i = 0; i < 4; ++i) {
    for (const AnyVolume& volume : volumes_of_every_kind(random, unit)) {
      Eigen::Isometry3d away(random.isometry(1).linear());
      away.translation() = random.vector(4) - away.linear() * center(volume);
      (i % 2 == 0 ? first : second).push_back(transformed(volume, away));
    }
  }
  first.emplace_back(Sphere());
  second.emplace_back(Hull());
  const MovingVolumes volumes(first), others(second);
  for (const double margin : {0.0, 0.5}) {
    const Eigen::Isometry3d pose = random.isometry(0.5);
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs, expected;
    list_within(volumes, others, pose, margin, pairs);
    for (std::size_t i = 0; i < first.size(); ++i) {
      for (std::size_t j = 0; j < second.size(); ++j) {
        if (within(ConvexBody(first[i]), ConvexBody(second[j]).transformed(pose), margin))
          expected.emplace_back(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j));
      }
    }
    EXPECT_EQ(pairs, expected);
    EXPECT_GT(pairs.size(), 10U);
    EXPECT_TRUE(within(volumes, others, pose, margin));
  }
  Eigen::Isometry3d far = Eigen::Isometry3d::Identity();
  far.translation().x() = 1e3;
  EXPECT_FALSE(within(volumes, others, far));
}

TEST(VolumesWithin, RefuseNoMarginAndNoPose) {
  const PointTree tree;
  const MovingVolumes none({});
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  EXPECT_FALSE(within(none, none, pose, 1));
  for (const double margin : {-1.0, kNan, 1e101}) {
    EXPECT_THROW(within(tree, tree, pose, margin), std::invalid_argument);
    EXPECT_THROW(within(tree, none, pose, margin), std::invalid_argument);
    EXPECT_THROW(within(none, none, pose, margin), std::invalid_argument);
  }
  pose(1, 3) = kInfinity;
  EXPECT_THROW(within(tree, none, pose, 0), std::invalid_argument);
}

}  // namespace
}  // namespace pcl_bv::detail
