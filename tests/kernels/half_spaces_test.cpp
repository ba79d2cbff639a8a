// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Which points are inside half-spaces: the same for every instruction set, layout and tail.

#include "pcl_bv/kernels/half_spaces.h"

#include <gtest/gtest.h>

#include <limits>

#include "clouds.h"

namespace pcl_bv::detail {
namespace {

std::vector<std::uint32_t> outside(Isa isa, const PointView& points, const HalfSpaces& inside) {
  std::vector<std::uint32_t> positions(points.count);
  positions.resize(list_outside(isa, points, inside, positions.data()));
  return positions;
}

// The six sides of a box, and slanted ones.
HalfSpaces box(double half, double ball) {
  HalfSpaces result;
  result.center = {0.25, -0.5, 0.125};
  for (const auto& n : {std::array{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {0.625, 0.5, 0.25}}) {
    for (const double sign : {1.0, -1.0})
      result.planes[result.count++] = {sign * n[0], sign * n[1], sign * n[2], half};
  }
  result.squared_ball = ball;
  return result;
}

template <typename T>
void expect_like_the_definition(std::size_t planes) {
  for (const std::size_t n : {0, 1, 3, 7, 8, 15, 16, 17, 31, 33, 100, 1000, 5003}) {
    const test::TestCloud<T> cloud = test::gaussian<T>(n, n + 1);
    HalfSpaces inside = box(0.75, planes == 8 ? 0.25 : 0);
    inside.count = planes;
    std::vector<std::uint32_t> expected;
    for (std::size_t i = 0; i < n; ++i) {
      const T x = cloud.xyz[3 * i] - T(0.25), y = cloud.xyz[3 * i + 1] + T(0.5),
              z = cloud.xyz[3 * i + 2] - T(0.125);
      bool in = true;
      for (std::size_t k = 0; k < inside.count; ++k) {
        const HalfSpace& h = inside.planes[k];
        in = in && (T(h.x) * x + T(h.y) * y) + T(h.z) * z < T(h.limit);
      }
      if (!in) expected.push_back(static_cast<std::uint32_t>(i));
    }
    for (const Isa isa : usable_isas()) {
      SCOPED_TRACE(std::string(isa_name(isa)) + ", " + std::to_string(n));
      EXPECT_EQ(outside(isa, cloud.view(), inside), expected);
      const test::Records<T> wide(cloud, 32, 4), padded(cloud, 4 * sizeof(T));
      EXPECT_EQ(outside(isa, wide.view(), inside), expected);
      EXPECT_EQ(outside(isa, padded.view(), inside), expected);
    }
  }
}

TEST(HalfSpaces, FloatPointsAreListedAsDefined) {
  for (const std::size_t planes : {1, 2, 8})
    expect_like_the_definition<float>(planes);
}
TEST(HalfSpaces, DoublePointsAreListedAsDefined) {
  for (const std::size_t planes : {1, 2, 8})
    expect_like_the_definition<double>(planes);
}

TEST(HalfSpaces, WhatIsNotFiniteIsOutsideAndWithoutPlanesAllIs) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  std::vector<float> xyz(3 * 40, 0.0F);
  xyz[3 * 5] = nan;
  xyz[3 * 20 + 1] = inf;
  xyz[3 * 39 + 2] = -inf;
  const PointView points = PointView::of(xyz.data(), 12, 40);
  for (const Isa isa : usable_isas()) {
    EXPECT_EQ(outside(isa, points, box(0.75, 0)), (std::vector<std::uint32_t>{5, 20, 39})) << isa_name(isa);
    EXPECT_EQ(outside(isa, points, box(0.75, 0.5)), (std::vector<std::uint32_t>{5, 20, 39})) << isa_name(isa);
    EXPECT_EQ(outside(isa, points, HalfSpaces()).size(), 40u) << isa_name(isa);
  }
}

TEST(HalfSpaces, OfZerosHasNothingInside) {
  const test::TestCloud<float> cloud = test::gaussian<float>(100, 2);
  HalfSpaces zeros;
  zeros.count = 1;
  for (const Isa isa : usable_isas())
    EXPECT_EQ(outside(isa, cloud.view(), zeros).size(), 100u) << isa_name(isa);
}

TEST(HalfSpaces, AnIndexListIsFollowed) {
  const test::TestCloud<float> cloud = test::gaussian<float>(500, 3);
  std::vector<std::int32_t> indices;
  for (int i = 499; i >= 0; i -= 3)
    indices.push_back(i);
  PointView listed = cloud.view();
  listed.indices = indices.data();
  listed.count = indices.size();
  const std::vector<std::uint32_t> expected = outside(Isa::scalar, listed, box(0.75, 0.25));
  EXPECT_GT(expected.size(), 10u);
  EXPECT_LT(expected.size(), indices.size());
  for (const Isa isa : usable_isas())
    EXPECT_EQ(outside(isa, listed, box(0.75, 0.25)), expected) << isa_name(isa);
}

}  // namespace
}  // namespace pcl_bv::detail
