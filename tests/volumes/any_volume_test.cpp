// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of the variant: it forwards.
#include <gtest/gtest.h>

#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;

TEST(AnyVolume, NamesItsShape) {
  EXPECT_EQ(shape_name(Aabb()), "aabb");
  EXPECT_EQ(shape_name(Kdop()), "kdop");
  EXPECT_EQ(shape_name(Sphere()), "sphere");
  EXPECT_EQ(shape_name(Obb()), "obb");
  EXPECT_EQ(shape_name(Cylinder()), "cylinder");
  EXPECT_EQ(shape_name(Capsule()), "capsule");
  EXPECT_EQ(shape_name(Ellipsoid()), "ellipsoid");
  EXPECT_EQ(shape_name(Hull()), "hull");
  EXPECT_EQ(shape_name(Prism()), "prism");
}

TEST(AnyVolume, ForwardsToTheVolumeHeld) {
  const Aabb box({0, 0, 0}, {1, 2, 4});
  const AnyVolume volumes[] = {box, Kdop().extend(box.min()).extend(box.max()), Sphere({0.5, 1, 2}, 3),
                               Obb(box),
                               Prism(Eigen::Matrix3d::Identity(), {{0, 0}, {1, 0}, {1, 2}, {0, 2}}, 0, 4)};
  for (const AnyVolume& v : volumes) {
    SCOPED_TRACE(shape_name(v));
    EXPECT_FALSE(empty(v));
    EXPECT_TRUE(contains(v, {0.5, 1, 2}));
    EXPECT_FALSE(contains(v, {9, 9, 9}));
    EXPECT_TRUE(center(v).isApprox(Vector3d(0.5, 1, 2)));
    EXPECT_EQ(volume(v), std::visit([](const auto& held) { return held.volume(); }, v));
    EXPECT_EQ(surface_area(v), std::visit([](const auto& held) { return held.surface_area(); }, v));
    EXPECT_EQ(aabb(v), std::visit([](const auto& held) { return held.aabb(); }, v));
    EXPECT_FALSE(mesh(v).vertices.empty());
    EXPECT_EQ(support(v, {1, 2, 3}), std::visit(
                                         [](const auto& held) {
                                           return Vector3d(held.support({1, 2, 3}));
                                         },
                                         v));
    EXPECT_EQ(distance(v, {9, 9, 9}), std::visit(
                                          [](const auto& held) {
                                            return held.distance({9, 9, 9});
                                          },
                                          v));
    EXPECT_LT(distance(v, {9, 2, 4}), 9);
    EXPECT_TRUE(intersect(v, {-9, 1, 2}, {1, 0, 0}));
    EXPECT_FALSE(intersect(v, {-9, 1, 2}, {-1, 0, 0}));
    const Eigen::Isometry3d shift(Eigen::Translation3d(10, 0, 0));
    EXPECT_EQ(shape_name(transformed(v, shift)), shape_name(v));
    EXPECT_TRUE(center(transformed(v, shift)).isApprox(Vector3d(10.5, 1, 2)));
  }
}

template <typename Volume>
void expect_unequal(const Volume& a, const Volume& b) {
  EXPECT_TRUE(a == a && b == b && !(a == b));
  EXPECT_TRUE(a != b && !(a != a) && !(b != b));
}

TEST(AnyVolume, OfAnyShapeIsUnequalToAnotherOneOnly) {
  const Vector3d o(0, 0, 0), a(1, 0, 0), b(0, 2, 0);
  expect_unequal(Aabb(o, a), Aabb(o, b));
  expect_unequal(Aabb(o, b), Aabb(b, b));
  expect_unequal(Kdop().extend(a), Kdop().extend(b));
  const SlabVector zero = SlabVector::Zero(7), one = SlabVector::Ones(7), two = 2 * one;
  expect_unequal(Kdop(KdopSet::dop14(), zero, one), Kdop(KdopSet::dop14(), zero, two));
  expect_unequal(Kdop(KdopSet::dop14(), zero, two), Kdop(KdopSet::dop14(), one, two));
  expect_unequal(*KdopSet::dop14(), *KdopSet::dop18());
  expect_unequal(Sphere(a, 1), Sphere(b, 1));
  expect_unequal(Obb(Aabb(o, a)), Obb(Aabb(o, b)));
  expect_unequal(Cylinder(o, a, 1, 2), Cylinder(o, b, 1, 2));
  expect_unequal(Capsule(o, a, 1), Capsule(o, b, 1));
  expect_unequal(Ellipsoid(o, Eigen::Matrix3d::Identity(), {1, 2, 3}),
                 Ellipsoid(o, Eigen::Matrix3d::Identity(), {1, 2, 4}));
  expect_unequal(Hull({a}, {}, {{a, 1}}, 0), Hull({b}, {}, {{b, 2}}, 0));
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  expect_unequal(Prism(axes, {{0, 0}}, 1, 2), Prism(axes, {{0, 1}}, 1, 2));
  expect_unequal(Prism(axes, {{0, 0}}, 1, 2), Prism(axes, {{0, 0}}, 1, 3));
}

TEST(AnyVolume, AnEmptyOneIsUnequalToOthers) {
  const Vector3d o(0, 0, 0), a(1, 0, 0);
  expect_unequal(Aabb(), Aabb(o, a));
  expect_unequal(Kdop(), Kdop().extend(a));
  expect_unequal(Sphere(), Sphere(a, 1));
  expect_unequal(Obb(), Obb(Aabb(o, a)));
  expect_unequal(Cylinder(), Cylinder(o, a, 1, 2));
  expect_unequal(Capsule(), Capsule(o, a, 1));
  expect_unequal(Ellipsoid(), Ellipsoid(o, Eigen::Matrix3d::Identity(), {1, 2, 3}));
  expect_unequal(Hull(), Hull({a}, {}, {{a, 1}}, 0));
  expect_unequal(Prism(), Prism(Eigen::Matrix3d::Identity(), {{0, 0}}, 1, 2));
}

TEST(AnyVolume, IsAnEmptyBoxAtFirst) {
  EXPECT_TRUE(empty(AnyVolume()));
  EXPECT_EQ(shape_name(AnyVolume()), "aabb");
}

}  // namespace
}  // namespace pcl_bv::detail
