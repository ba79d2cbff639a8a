// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Bounds of a VolumeTree's nodes against their definitions in long double: never beyond what they bound, and
// no looser than their margins say.

#include "node_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace pcl_bv {
namespace {

using namespace testing;
Real distance_to(const Shape& shape, NodeBounds kind, const RealVector& p) {
  if (kind == NodeBounds::sphere) return (p - shape.center).norm() - shape.radius;
  Real farthest = 0;
  for (const Slab& slab : shape.slabs) {
    const Real s = slab.direction.dot(p);
    farthest = std::max(farthest, std::max(slab.low - s, s - slab.high) / std::sqrt(3.0L));
  }
  return farthest;
}

// Where a ray is between the sides of slabs and in a ball, grown; infinity where nothing is left.
Real enters(const std::vector<Slab>& slabs, const FrameRay& ray, Real growth) {
  const RealVector at = ray.from.at.cast<Real>(), u = ray.u.cast<Real>();
  Real enter = 0, exit = kFar;
  for (const Slab& slab : slabs) {
    const Real start = slab.direction.dot(at), slope = slab.direction.dot(u);
    const Real low = slab.low - growth - start, high = slab.high + growth - start;
    if (low > high || (slope == 0 && (low > 0 || high < 0))) return kFar;
    if (slope == 0) continue;
    enter = std::max(enter, (slope > 0 ? low : high) / slope);
    exit = std::min(exit, (slope > 0 ? high : low) / slope);
  }
  return enter - ray.underflow_margin <= exit + ray.underflow_margin
             ? std::max(0.0L, enter - ray.underflow_margin)
             : kFar;
}

Real enters(const Shape& shape, NodeBounds kind, const FrameRay& ray, Real growth) {
  if (kind == NodeBounds::dop14) return enters(shape.slabs, ray, growth);
  const RealVector u = ray.u.cast<Real>(), q = shape.center - ray.from.at.cast<Real>();
  const Real radius = shape.radius + growth, nearest = q.dot(u) / u.squaredNorm();
  const Real half = radius * radius - (q - nearest * u).squaredNorm();
  if (!(radius >= 0 && half >= 0)) return kFar;
  const Real reach = std::sqrt(half / u.squaredNorm());
  return nearest + reach >= -2 * ray.underflow_margin ? std::max(0.0L, nearest - reach - ray.underflow_margin)
                                                      : kFar;
}

std::vector<Slab> sides(const BoxGroup& group, std::size_t k) {
  std::vector<Slab> slabs;
  for (int axis = 0; axis < 3; ++axis)
    slabs.push_back({RealVector::Unit(axis), group.low[axis][k], group.high[axis][k]});
  return slabs;
}

// A k-DOP whose aabb() is empty and for which extent_of() finds a box all the same.
Kdop missing_slabs(double size) {
  const auto set =
      std::make_shared<const KdopSet>(std::vector<Vector3d>{{1, 2, 3}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}});
  SlabVector min = SlabVector::Constant(4, -size), max = SlabVector::Constant(4, size);
  min[0] = 50 * size, max[0] = 60 * size;
  const Kdop kdop(set, min, max);
  EXPECT_TRUE(kdop.aabb().empty());
  EXPECT_LT(extent_of(kdop).high.x, size);
  EXPECT_GE(extent_of(kdop).high.x, 0.5 * size);
  return kdop;
}

std::vector<Tree> trees() {
  Random random(31);
  std::vector<Tree> all;
  for (const Scale& scale : {Scale{"unit", 0, 1}, Scale{"utm, 1 mm", 5e6, 1e-3}, Scale{"1e6", 0, 1e6}}) {
    for (const std::size_t count : {1, 9, 40, 256}) {  // 256: no box is missing in the last group
      std::vector<AnyVolume> volumes = scattered_volumes(random, scale, count, count > 9 ? 30 : 0.1);
      std::shuffle(volumes.begin(), volumes.end(), std::mt19937(count));
      if (scale.offset > 0) {  // near one another, so that margins of coordinates show
        std::erase_if(volumes, [](const AnyVolume& v) { return std::abs(center(v).z() - 5e5) > 1; });
      }
      volumes.resize(count, Sphere({5e6, -5e6, 5e5}, 2e-3));
      for (std::size_t i = 0; scale.offset == 0 && count > 9 && i < 20; ++i)
        volumes[i] = odd_volumes(scale.extent)[i % 12];
      if (scale.offset == 0 && count > 9) volumes[20] = missing_slabs(scale.extent);
      for (const NodeBounds kind : {NodeBounds::dop14, NodeBounds::sphere})
        all.emplace_back(volumes, kind);
    }
  }
  return all;
}

// Places in the boxes' frame: all over it, at its middle, and from afar.
Vector3d place_in(Random& random, const Tree& tree, int i) {
  constexpr std::array<double, 6> spans = {1, 0.1, 3, 30, 1e3, 1e6};
  return vector(tree.boxes.levels().origin) +
         random.vector(spans[static_cast<std::size_t>(i) % spans.size()]) / tree.boxes.levels().scale;
}

TEST(NodeBounds, DistancesAreThoseToTheShapesLessTheSlack) {
  Random random(32);
  std::size_t apart = 0;
  for (const Tree& tree : trees()) {
    for (int i = 0; i < 18; ++i) {
      const Vector3d p = place_in(random, tree, i);
      const FramePoint place(tree.boxes, coordinates(p));
      ASSERT_EQ(place.margin, VolumeBoxes::margin(place.at.cwiseAbs().maxCoeff()));
      for (std::size_t n = 0; n < tree.expected.size(); ++n) {
        const Shape& shape = tree.expected[n];
        const double found = tree.shapes.distance(n, place);
        const Real expected = std::max(
            0.0L, distance_to(shape, tree.kind, place.at.cast<Real>()) - 2 * static_cast<Real>(place.margin));
        if (expected < kFar) {
          const Real rounding = 1e-12L * (1 + std::abs(expected));
          const Real above = tree.kind == NodeBounds::dop14 ? 0 : shape.tolerance;
          ASSERT_LE(found, expected + above + rounding) << n;
          ASSERT_GE(found, expected - shape.tolerance - rounding) << n;
        } else {
          ASSERT_EQ(found, kInfinity);
        }
        const std::uint32_t bits = 0x5a5aU << n % 2;
        ASSERT_EQ(tree.shapes.may_contain(n / kTreeWidth, bits, place) >> n % kTreeWidth & 1U,
                  found == 0 ? bits >> n % kTreeWidth & 1U : 0U);
        apart += found > 0 && found < kInfinity;
        for (const std::uint32_t number : shape.volumes) {
          if (empty(tree.volumes[number]) || found == 0 || found == kInfinity) continue;
          ASSERT_LE(found, distance(tree.volumes[number], p) * tree.boxes.levels().scale);
        }
      }
    }
  }
  EXPECT_GT(apart, 10000U);
}

std::vector<FrameRay> rays_through(Random& random, const Tree& tree) {
  std::vector<FrameRay> rays;
  for (int i = 0; i < 60; ++i) {
    const Vector3d origin = place_in(random, tree, i);
    Vector3d direction = place_in(random, tree, 1) - origin;
    if (i % 5 == 1) direction = Vector3d::Unit(i % 3);
    if (i % 5 == 2) direction = Vector3d::Unit(i % 3) - Vector3d::Unit((i + 1) % 3);
    if (i % 7 == 3) direction *= -0.5;
    if (i % 5 == 4) direction = direction / direction.cwiseAbs().maxCoeff() * 0x1p1018;
    const FrameRay ray(tree.boxes, coordinates(origin), coordinates(direction));
    rays.push_back(ray);
    EXPECT_GE(ray.u.cwiseAbs().maxCoeff(), 1);
    EXPECT_LT(ray.u.cwiseAbs().maxCoeff(), 2);
    for (int k = 0; k < 3; ++k)  // all powers of two: nothing is rounded
      EXPECT_EQ(ray.u[k], std::ldexp(direction[k], std::ilogb(tree.boxes.levels().scale) - ray.exponent));
    EXPECT_EQ(ray.underflow_margin, ray.time(0x1p-1020));
  }
  return rays;
}

// Between where the ray enters what is a little larger and what is a little smaller.
void expect_between(double found, Real first, Real last) {
  ASSERT_GE(found, 0);
  ASSERT_GE(found, first < kFar ? first - 1e-9L * (1 + first) : kFar);
  ASSERT_LE(found, last + 1e-9L * (1 + last));
}

TEST(NodeBounds, RaysEnterTheShapesGrownByFourTimesTheSlack) {
  Random random(33);
  std::size_t hits = 0, misses = 0;
  for (const Tree& tree : trees()) {
    for (const FrameRay& ray : rays_through(random, tree)) {
      for (std::size_t n = 0; n < tree.expected.size(); ++n) {
        const Shape& shape = tree.expected[n];
        const Real slack = ray.from.margin, room = shape.tolerance + 0.02L * slack;
        const double found = tree.shapes.enter(n, ray);
        ASSERT_NO_FATAL_FAILURE(expect_between(found, enters(shape, tree.kind, ray, 4 * slack + room),
                                               enters(shape, tree.kind, ray, 4 * slack - room)))
            << n << " at " << ray.from.at.transpose() << " to " << ray.u.transpose() << ", " << shape.radius;
        (found < kInfinity ? hits : misses) += found > 0;
      }
    }
  }
  EXPECT_GT(hits, 1000U);
  EXPECT_GT(misses, 1000U);
}

TEST(NodeBounds, BoxesAreAsFarAndEnteredAsTheirSidesSay) {
  Random random(34);
  for (const Tree& tree : trees()) {
    const std::vector<BoxGroup>& groups = tree.boxes.levels().groups;
    for (const FrameRay& ray : rays_through(random, tree)) {
      const Real slack = ray.from.margin;
      for (std::size_t n = 0; n < groups.size() * kTreeWidth; ++n) {
        const std::vector<Slab> box = sides(groups[n / kTreeWidth], n % kTreeWidth);
        Real squares = 0;
        for (const Slab& side : box) {
          const Real s = side.direction.dot(ray.from.at.cast<Real>());
          squares += std::pow(std::max({0.0L, side.low - s, s - side.high}), 2.0L);
        }
        const Real expected = std::max(0.0L, std::sqrt(squares) - 2 * slack);
        const double found = distance_to_box(ray.from, groups[n / kTreeWidth], n % kTreeWidth);
        ASSERT_LE(found, expected + 1e-12L * (1 + expected));
        ASSERT_GE(found, expected < kFar ? expected - 1e-12L * (1 + expected) : kFar);
        ASSERT_NO_FATAL_FAILURE(expect_between(enter_box(ray, groups[n / kTreeWidth], n % kTreeWidth),
                                               enters(box, ray, 1.02L * slack),
                                               enters(box, ray, 0.98L * slack)));
      }
    }
  }
}

TEST(NodeBounds, OfBoxesAloneAreNone) {
  const Tree tree({Sphere({1, 2, 3}, 1), Sphere()}, NodeBounds::aabb);
  EXPECT_TRUE(tree.shapes.none());
  EXPECT_FALSE(Tree(tree.volumes, NodeBounds::sphere).shapes.none());
  EXPECT_FALSE(Tree(tree.volumes, NodeBounds::dop14).shapes.none());
}

}  // namespace
}  // namespace pcl_bv
