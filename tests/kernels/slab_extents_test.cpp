// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of the extents along three axes in double.

#include "pcl_bv/kernels/slab_extents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "clouds.h"
#include "directions.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/points/point_groups.h"

namespace pcl_bv::detail {
namespace {

using Axes = std::array<Direction, 3>;

Axes some_axes(std::uint64_t seed) {
  const test::Directions random = test::random_directions(3, seed);
  return {random[0], random[1], random[2]};
}

// Written anew from the header: what each point contributes.
template <typename T>
SlabExtents expected(const test::TestCloud<T>& cloud, const Coordinates& origin, const Axes& axes) {
  SlabExtents all;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Coordinates p = load_point(cloud.view(), i);
    if (!is_valid(p)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = axes[k][0] * (p.x - origin.x), y = axes[k][1] * (p.y - origin.y);
      const double s = (x + y) + axes[k][2] * (p.z - origin.z);
      all.low[k] = std::min(all.low[k], s);
      all.high[k] = std::max(all.high[k], s);
    }
  }
  return all;
}

void expect_equal(const SlabExtents& a, const SlabExtents& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(a.low[k], b.low[k]);
    EXPECT_EQ(a.high[k], b.high[k]);
    EXPECT_FALSE((a.low[k] == 0 && std::signbit(a.low[k])) || (a.high[k] == 0 && std::signbit(a.high[k])));
  }
}

template <typename T>
void expect_same_on_every_set_and_layout() {
  const FloatEnvironment environment;
  for (const test::TestCloud<T>& cloud : test::nasty_clouds<T>()) {
    Coordinates origin{};
    for (std::size_t i = 0; i < cloud.size() && !(is_valid(origin) && i > 0 && i > cloud.size() / 2); ++i) {
      if (is_valid(load_point(cloud.view(), i))) origin = load_point(cloud.view(), i);
    }
    std::vector<std::int32_t> all(cloud.size());
    std::iota(all.rbegin(), all.rend(), 0);
    const test::Records<T> wide(cloud, 8 * sizeof(T), sizeof(T)), padded(cloud, 4 * sizeof(T));
    PointView listed = cloud.view();
    listed.indices = all.data();
    const Axes axes = some_axes(cloud.size());
    const SlabExtents right = expected(cloud, origin, axes);
    for (const Isa isa : usable_isas()) {
      SCOPED_TRACE(cloud.name + ", " + std::string(isa_name(isa)));
      const PointGroups groups(cloud.view());
      for (const PointView& view : {cloud.view(), wide.view(), padded.view(), listed, groups.view()})
        expect_equal(slab_extents(isa, view, origin, axes), right);
    }
  }
}

TEST(SlabExtents, OfFloatsAreTheSameBitsOnEverySetAndLayout) {
  expect_same_on_every_set_and_layout<float>();
}
TEST(SlabExtents, OfDoublesAreTheSameBitsOnEverySetAndLayout) {
  expect_same_on_every_set_and_layout<double>();
}

template <typename T>
void expect_offsets_give_the_same() {
  const FloatEnvironment environment;
  std::vector<test::TestCloud<T>> clouds = test::nasty_clouds<T>();
  for (std::size_t n = 1; n <= 40; ++n)
    clouds.push_back(test::gaussian<T>(n, n));
  for (const test::TestCloud<T>& cloud : clouds) {
    const PointView block = cloud.view().slice(0, std::min(cloud.size(), kBlockPoints));
    const Axes axes = some_axes(cloud.size());
    for (const Isa isa : usable_isas()) {
      SCOPED_TRACE(cloud.name + ", " + std::string(isa_name(isa)));
      BlockOffsets offsets;
      const Moments moments = block_moments(isa, block, offsets);
      const SlabExtents right =
          moments.count > 0 ? slab_extents(isa, block, moments.origin, axes) : SlabExtents();
      expect_equal(slab_extents(isa, offsets, axes), right);
    }
  }
}

TEST(SlabExtents, OfOffsetsAreThoseOfTheirPoints) {
  expect_offsets_give_the_same<float>();
  expect_offsets_give_the_same<double>();
}

// Products that cancel only if none is fused with a sum.
TEST(SlabExtents, NeverFuses) {
  const FloatEnvironment environment;
  const double a = 1 + 0x1p-30;
  test::TestCloud<double> cloud{"", {0, 0, 0}};
  for (int i = 0; i < 40; ++i)
    cloud.xyz.insert(cloud.xyz.end(), {a, -a, 0.0});
  for (const Isa isa : usable_isas()) {
    const SlabExtents found =
        slab_extents(isa, cloud.view(), {0, 0, 0}, {{{a, a, 0}, {a, a, 1}, {-a, -a, 0}}});
    EXPECT_EQ(found.low, (std::array<double, 3>{}));
    EXPECT_EQ(found.high, (std::array<double, 3>{}));
  }
}

TEST(SlabExtents, AZeroOfNegativeProductsHasNoSign) {
  const FloatEnvironment environment;
  const test::TestCloud<double> cloud{"", std::vector<double>(3 * 40, 0.0)};
  for (const Isa isa : usable_isas()) {
    const SlabExtents found =
        slab_extents(isa, cloud.view(), {0, 0, 0}, {{{-1, -1, -1}, {-1, -2, -3}, {-3, -2, -1}}});
    expect_equal(found, SlabExtents{{0, 0, 0}, {0, 0, 0}});
  }
}

}  // namespace
}  // namespace pcl_bv::detail
