// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/trees/point_tree.h"

#include <gtest/gtest.h>

#include "any_volumes.h"
#include "clouds.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;

// Whether the volume holds the image by exact arithmetic, for the kinds that have judges in rationals.
bool surely_inside(const AnyVolume& volume, const ExactPoint& p) {
  return std::visit([&](const auto& shape) { return !shape.empty() && inside(shape, p); }, volume);
}

TEST(PosedTree, MissesNoPointWhoseImageIsInsideByExactArithmetic) {
  Random random(1);
  for (const Scale& scale : scales()) {
    if (scale.extent < 1e-30 || scale.extent > 1e30) continue;  // transformed() multiplies
    std::size_t inside_count = 0;
    for (const AnyVolume& volume : volumes_of_every_kind(random, scale)) {
      const Eigen::Isometry3d pose = random.isometry(scale.extent);
      test::TestCloud<double> cloud;
      for (const Vector3d& p : points_about(random, volume, 1e-3 * scale.extent, 20)) {
        const Vector3d moved_back = pose.inverse() * p;
        cloud.xyz.insert(cloud.xyz.end(), moved_back.begin(), moved_back.end());
      }
      const PointTree tree(cloud.view());
      const PosedTree posed(tree, pose);
      std::vector<std::int32_t> found;
      posed.all_inside(volume, found);
      EXPECT_EQ(posed.count_inside(volume), found.size());
      EXPECT_EQ(posed.any_inside(volume), !found.empty());
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        const Coordinates p = load_point(cloud.view(), i);
        if (!surely_inside(volume, image(pose, exact(Vector3d(p.x, p.y, p.z))))) continue;
        ++inside_count;
        ASSERT_TRUE(std::binary_search(found.begin(), found.end(), static_cast<std::int32_t>(i)))
            << shape_name(volume) << ", " << scale.name;
      }
    }
    EXPECT_GT(inside_count, 100U) << scale.name;
  }
}

// Far away from the surface there is nothing that rounding could add.
TEST(PosedTree, FindsNothingThatIsClearlyOutside) {
  Random random(2);
  const auto cloud = test::gaussian<float>(5000, 3);
  const PointTree tree(cloud.view());
  for (const AnyVolume& volume : volumes_of_every_kind(random, {"unit", 0, 1})) {
    const Eigen::Isometry3d pose = random.isometry(1);
    std::vector<std::int32_t> found;
    PosedTree(tree, pose).all_inside(volume, found);
    for (const std::int32_t i : found) {
      const Coordinates p = load_point(cloud.view(), static_cast<std::size_t>(i));
      ASSERT_LE(distance(volume, pose * Vector3d(p.x, p.y, p.z)), 1e-9) << shape_name(volume);
    }
  }
}

TEST(PosedTree, HasTheNeighboursOfAMovedCloud) {
  Random random(4);
  const auto cloud = test::gaussian<double>(2000, 5);
  const Eigen::Isometry3d pose = random.isometry(3);
  test::TestCloud<double> moved;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Coordinates p = load_point(cloud.view(), i);
    const Vector3d image = pose * Vector3d(p.x, p.y, p.z);
    moved.xyz.insert(moved.xyz.end(), image.begin(), image.end());
  }
  const PointTree tree(cloud.view()), other(moved.view());
  const PosedTree posed(tree, pose);
  for (int round = 0; round < 100; ++round) {
    const Vector3d place = pose * random.vector(3), direction = random.vector(1);
    std::vector<Neighbor> found, expected;
    posed.nearest(place, 10, found);
    other.nearest(place, 10, expected);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].index, expected[i].index);
      EXPECT_NEAR(found[i].squared_distance, expected[i].squared_distance, 1e-12);
    }
    EXPECT_EQ(posed.nearest(place)->index, expected.front().index);
    const auto hit = posed.first_hit(place, direction, 0.1), there = other.first_hit(place, direction, 0.1);
    ASSERT_EQ(hit.has_value(), there.has_value());
    EXPECT_EQ(hit.value_or(PointHit{-1, 0}).index, there.value_or(PointHit{-1, 0}).index);
  }
}

TEST(PosedTree, RefusesAPoseThatIsNotRigid) {
  const PointTree tree;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose(0, 0) = 2;
  EXPECT_THROW(PosedTree(tree, pose), std::invalid_argument);
  pose(0, 0) = kNan;
  EXPECT_THROW(PosedTree(tree, pose), std::invalid_argument);
  pose(0, 0) = 1;
  pose(1, 3) = kInfinity;
  EXPECT_THROW(PosedTree(tree, pose), std::invalid_argument);
  pose(1, 3) = 0;
  for (const int row : {0, 2}) {
    pose(row, 1) = 1e-6;
    EXPECT_NO_THROW(PosedTree(tree, pose)) << row;
    for (const double skew : {std::nextafter(1e-6, 1.0), 1.5e-6, -1.5e-6}) {
      pose(row, 1) = skew;
      EXPECT_THROW(PosedTree(tree, pose), std::invalid_argument) << row << ", " << skew;
    }
    pose(row, 1) = 0;
  }
}

TEST(PosedTree, OfNoPointsFindsNone) {
  const PointTree tree;
  EXPECT_FALSE(PosedTree(tree, Eigen::Isometry3d::Identity()).any_inside(Sphere({0, 0, 0}, 1)));
}

// How far from the image of the tree's outermost point a ball of no radius may be that holds it.
double rounding_of(const PointTree& tree, const Eigen::Isometry3d& pose, const Vector3d& image) {
  const PosedTree posed(tree, pose);
  const auto holds = [&](double t) { return posed.any_inside(Sphere(image + Vector3d(0, t, 0), 0)); };
  double in = 0, out = 1e-3 * (1 + image.norm());
  EXPECT_TRUE(holds(in));
  EXPECT_FALSE(holds(out));
  while (out - in > 1e-3 * out && out > 1e-60) {
    const double middle = in > 0 ? std::sqrt(in * out) : 1e-3 * out;
    (holds(middle) ? in : out) = middle;
  }
  return in;
}

// The bound of roundings is 2^-46 of the coordinates, before and after; of a pose that is not quite rigid,
// what its inverse by one step of Newton's is off by, too.
TEST(PosedTree, ErrsByTheRoundingOfTheCoordinates) {
  Random random(8);
  for (const double place : {0.0, 1e-20, 1e-3, 1.0, 1e6}) {
    for (const double shift : {0.0, 1e-3, 1.0, 1e6}) {
      const Vector3d p = random.vector(place);
      Eigen::Isometry3d pose = random.isometry(shift);
      if (place == 0) pose.linear().setIdentity();
      const std::array<Vector3d, 2> points = {p, -0.25 * p};
      const PointTree tree(PointView::of(points[0].data(), 24, 2));
      const double shifts = pose.translation().lpNorm<1>() + pose.inverse().translation().lpNorm<1>();
      const double expected = 0x1p-46 * (p.lpNorm<1>() + shifts), found = rounding_of(tree, pose, pose * p);
      EXPECT_GE(found, 0.9 * expected) << place << ", " << shift;
      EXPECT_LE(found, 1.2 * expected + 1e-48) << place << ", " << shift;
      pose.linear().col(0) += 9e-7 * pose.linear().col(1);
      const double skewed = rounding_of(tree, pose, pose * p);
      EXPECT_GE(skewed, 0.9 * expected) << place << ", " << shift;
      EXPECT_LE(skewed, 1.2 * expected + 8e-12 * p.lpNorm<1>() + 1e-48) << place << ", " << shift;
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
