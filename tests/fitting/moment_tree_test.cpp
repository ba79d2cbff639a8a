// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "moment_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "clouds.h"
#include "exact.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {
namespace {

using test::Rational;
using test::TestCloud;

template <typename T>
std::vector<Moments> moments_of_blocks(const TestCloud<T>& cloud) {
  std::vector<Moments> all;
  for (std::size_t block = 0; block * kBlockPoints < cloud.size(); ++block)
    all.push_back(block_moments(Isa::automatic, block_of(cloud.view(), block)));
  return all;
}

void expect_same_bits(const Moments& a, const Moments& b) {
  EXPECT_EQ(a.count, b.count);
  EXPECT_TRUE(a.origin == b.origin);
  EXPECT_EQ(a.exponent, b.exponent);
  EXPECT_EQ(std::memcmp(&a.sum, &b.sum, sizeof a.sum), 0);
  EXPECT_EQ(std::memcmp(&a.product, &b.product, sizeof a.product), 0);
}

// sum (p_i - o_i) (p_j - o_j), and of magnitudes, in units of the moments' exponent.
void expect_near_the_exact_sums(const TestCloud<double>& cloud, const Moments& moments, double bound) {
  constexpr std::size_t factors[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
  const double o[3] = {moments.origin.x, moments.origin.y, moments.origin.z};
  const Rational unit = Rational(std::ldexp(1.0, moments.exponent));
  Rational extent[3];
  for (std::size_t i = 0; i < cloud.xyz.size(); ++i)
    extent[i % 3] =
        std::max(extent[i % 3], Rational(abs((Rational(cloud.xyz[i]) - Rational(o[i % 3])) * unit)));
  for (std::size_t k = 0; k < 6; ++k) {
    Rational exact = 0;
    const auto [i, j] = factors[k];
    for (std::size_t p = 0; p < cloud.size(); ++p)
      exact += (Rational(cloud.xyz[3 * p + i]) - Rational(o[i])) *
               (Rational(cloud.xyz[3 * p + j]) - Rational(o[j]));
    const Rational room =
        Rational(bound) * extent[i] * extent[j] * Rational(static_cast<double>(cloud.size()));
    EXPECT_LE(abs(Rational(moments.product[k]) - exact * unit * unit), 4 * room + Rational(0x1p-1060)) << k;
  }
}

TEST(MomentTree, PartsThatAreSummedApartGiveTheBitsOfTheWhole) {
  const TestCloud<float> cloud = test::gaussian<float>(77 * kBlockPoints - 5, 1, 3, 5e6);
  const std::vector<Moments> blocks = moments_of_blocks(cloud);
  MomentTree whole;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    whole.append(b, blocks[b]);
  for (std::size_t cut = 0; cut <= blocks.size(); ++cut) {
    MomentTree parts[2];
    for (std::size_t b = 0; b < blocks.size(); ++b)
      parts[b < cut ? 0 : 1].append(b, blocks[b]);
    parts[0].append(0, parts[1]);
    SCOPED_TRACE(cut);
    expect_same_bits(parts[0].total(), whole.total());
  }
}

TEST(MomentTree, ChunksNumberTheirBlocksFromZero) {
  const TestCloud<float> cloud = test::gaussian<float>(70 * kBlockPoints, 2);
  const std::vector<Moments> blocks = moments_of_blocks(cloud);
  MomentTree whole, of_chunks;
  for (std::size_t first = 0; first < blocks.size(); first += 32) {
    MomentTree chunk;
    for (std::size_t b = first; b < std::min<std::size_t>(first + 32, blocks.size()); ++b) {
      whole.append(b, blocks[b]);
      chunk.append(b - first, blocks[b]);
    }
    of_chunks.append(first, chunk);
  }
  expect_same_bits(of_chunks.total(), whole.total());
}

TEST(MomentTree, OfNoValidPointIsEmptyWhereverItStands) {
  EXPECT_EQ(MomentTree().total().count, 0U);
  const TestCloud<float> cloud = test::gaussian<float>(100, 3);
  const Moments some = block_moments(Isa::automatic, cloud.view());
  MomentTree tree;
  tree.append(0, Moments());
  tree.append(1, some);
  tree.append(2, Moments());
  expect_same_bits(tree.total(), some);
}

// Of two small blocks, one after the other.
Moments merged_halves(const TestCloud<double>& cloud, bool swapped) {
  const std::size_t half = cloud.size() / 2;
  const PointView a = cloud.view().slice(0, half), b = cloud.view().slice(half, half);
  const Moments first = block_moments(Isa::automatic, swapped ? b : a);
  return merged(first, block_moments(Isa::automatic, swapped ? a : b));
}

TEST(MomentTree, MovesOriginsToWithinTheRoundingOfTheExtents) {
  // The blocks lie apart, so that nearly all of the sum is what moving the second origin adds.
  for (const double scale : {1.0, 1e-80, 1e-110, 1e-200, 1e-300, 1e90}) {
    TestCloud<double> cloud = test::gaussian<double>(80, 4, scale);
    for (std::size_t i = cloud.xyz.size() / 2; i < cloud.xyz.size(); ++i)
      cloud.xyz[i] += (static_cast<double>(i % 3) - 3.5) * 10 * scale;
    SCOPED_TRACE(cloud.name);
    expect_near_the_exact_sums(cloud, merged_halves(cloud, false), 30 * 0x1p-53);
  }
}

TEST(MomentTree, UnitsLeaveRoomForBlocksFarApartAndForBlocksOfManySizes) {
  // All the exponents that blocks of these extents have, and of equal points, at distances of all sizes.
  for (const double extent : {0.0, 1e-300, 1e-120, 1.0}) {
    for (const double other : {0.0, 1e-300, 1e-120, 1.0}) {
      for (const double apart : {0.0, 1e-310, 1e-250, 1e-130, 1e-80, 1.0, 1e99}) {
        TestCloud<double> cloud = test::gaussian<double>(20, 5);
        for (std::size_t i = 0; i < cloud.xyz.size(); ++i) {
          const bool second = i >= cloud.xyz.size() / 2;
          cloud.xyz[i] = (second ? other : extent) * cloud.xyz[i] + (second ? apart : 0);
        }
        SCOPED_TRACE(testing::Message() << extent << ", " << other << ", " << apart << " apart");
        for (const bool swapped : {false, true})
          expect_near_the_exact_sums(cloud, merged_halves(cloud, swapped), 30 * 0x1p-53);
      }
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
