// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Bounds of queries against a VolumeTree's boxes, compared with their definitions in long double. They are
// never beyond what they bound, and no looser than their margins say.

#include "box_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

#include "scattered_volumes.h"
#include "vectors.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;
using Real = long double;
using RealVector = Eigen::Matrix<Real, 3, 1>;

constexpr Real kFar = std::numeric_limits<Real>::infinity();

struct Slab {
  RealVector direction;
  Real low, high;
};

struct Tree {
  VolumeBoxes boxes;

  explicit Tree(const std::vector<AnyVolume>& volumes) {
    std::vector<PositionBounds> extents;
    std::transform(volumes.begin(), volumes.end(), std::back_inserter(extents), extent_of);
    boxes.build(extents, Serial{});
  }
};

// Where a ray enters the slabs, each extended by `growth` on both sides; infinity where it misses them.
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
      all.emplace_back(volumes);
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

TEST(BoxBounds, BoxesAreAsFarAndEnteredAsTheirSidesSay) {
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

}  // namespace
}  // namespace pcl_bv::detail
