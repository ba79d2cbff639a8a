// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/distances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "clouds.h"

namespace pcl_bv::detail {
namespace {

using test::Records;
using test::TestCloud;

constexpr double infinity = std::numeric_limits<double>::infinity();

// The middle of the cloud's box and the power of two below 1 / its extent, as fits use them.
DistanceCenter middle(const PointView& points) {
  double low[3] = {infinity, infinity, infinity}, high[3] = {-infinity, -infinity, -infinity};
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) continue;
    const double v[] = {p.x, p.y, p.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], v[axis]);
      high[axis] = std::max(high[axis], v[axis]);
    }
  }
  if (low[0] > high[0]) return {};
  DistanceCenter center{low[0] + (high[0] - low[0]) * 0.47, low[1] + (high[1] - low[1]) * 0.51,
                        low[2] + (high[2] - low[2]) * 0.44, 1};
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2], 1e-300});
  if (points.scalar == ScalarType::float64) center.scale = std::ldexp(1.0, -std::ilogb(extent));
  return center;
}

// The greatest of each block, over all octants.
std::vector<double> run(Isa isa, const PointView& points, const DistanceCenter& center, double limit,
                        FloatFilter filter) {
  std::vector<double> greatest;
  for (std::size_t begin = 0; begin < points.count; begin += kBlockPoints) {
    OctantScan scan{center, limit, filter};
    scan_octants(isa, points.slice(begin, std::min(kBlockPoints, points.count - begin)), scan);
    greatest.push_back(*std::max_element(scan.max_squared.begin(), scan.max_squared.end()));
  }
  return greatest;
}

std::vector<std::uint32_t> list(Isa isa, const PointView& points, const DistanceCenter& center, double limit,
                                FloatFilter filter) {
  std::vector<std::uint32_t> positions(points.count);
  positions.resize(list_distant(isa, points, center, limit, filter, positions.data()));
  return positions;
}

// The definition, with every step written out.
double by_definition(const Coordinates& p, const DistanceCenter& c) {
  const volatile double x = (p.x - c.x) * c.scale, y = (p.y - c.y) * c.scale, z = (p.z - c.z) * c.scale;
  const volatile double xx = x * x, yy = y * y, zz = z * z;
  const volatile double xy = xx + yy;
  return xy + zz;
}

TEST(DistancesReference, FollowsTheDefinition) {
  for (const TestCloud<double>& cloud : test::nasty_clouds<double>()) {
    SCOPED_TRACE(cloud.name);
    const PointView points = cloud.view();
    const DistanceCenter center = middle(points);
    std::vector<double> expected(block_count(points.count), -1);
    std::array<double, 8> octants;
    octants.fill(-1);
    std::vector<std::uint32_t> listed;
    for (std::size_t i = 0; i < points.count; ++i) {
      const Coordinates p = load_point(points, i);
      if (!is_valid(p)) continue;
      const double d2 = by_definition(p, center);
      expected[i / kBlockPoints] = std::max(expected[i / kBlockPoints], d2);
      const std::size_t o =
          (p.x > center.x ? 1U : 0U) + (p.y > center.y ? 2U : 0U) + (p.z > center.z ? 4U : 0U);
      if (d2 < 0.125) continue;
      octants[o] = std::max(octants[o], d2);
      listed.push_back(static_cast<std::uint32_t>(i));
    }
    EXPECT_EQ(run(Isa::scalar, points, center, 0, FloatFilter::reject), expected);
    EXPECT_EQ(list(Isa::scalar, points, center, 0.125, FloatFilter::off), listed);
    std::array<double, 8> found;
    found.fill(-1);
    for (std::size_t begin = 0; begin < points.count; begin += kBlockPoints) {
      OctantScan scan{center, 0.125};
      scan_octants(Isa::scalar, points.slice(begin, std::min(kBlockPoints, points.count - begin)), scan);
      for (std::size_t o = 0; o < 8; ++o)
        found[o] = std::max(found[o], scan.max_squared[o]);
    }
    EXPECT_EQ(found, octants);
  }
}

class DistanceParity : public testing::TestWithParam<Isa> {
 protected:
  void expect_parity(const PointView& points, const DistanceCenter& center) {
    for (const double limit : limits(run(Isa::scalar, points, center, 0, FloatFilter::off))) {
      for (const FloatFilter filter : {FloatFilter::off, FloatFilter::reject}) {
        EXPECT_EQ(list(GetParam(), points, center, limit, filter),
                  list(Isa::scalar, points, center, limit, filter));
        expect_same_octants(points, center, limit, filter);
      }
    }
  }

  void expect_same_octants(const PointView& points, const DistanceCenter& center, double limit,
                           FloatFilter filter) {
    for (std::size_t begin = 0; begin < points.count; begin += kBlockPoints) {
      const PointView block = points.slice(begin, std::min(kBlockPoints, points.count - begin));
      SCOPED_TRACE(testing::Message() << "limit " << limit);
      std::vector<float> bounds(kBlockBounds);
      OctantScan scan{center, limit, filter, filter == FloatFilter::reject ? bounds.data() : nullptr};
      OctantScan expected{center, limit};
      scan_octants(GetParam(), block, scan);
      scan_octants(Isa::scalar, block, expected);
      EXPECT_EQ(scan.max_squared, expected.max_squared);
      if (filter == FloatFilter::reject && points.scalar == ScalarType::float32) {
        for (const double other : {limit, limit * 0.5, limit * 1.00001})
          expect_reached(block, center, other, bounds.data());
      }
    }
  }

  void expect_reached(const PointView& block, const DistanceCenter& center, double limit,
                      const float* bounds) {
    std::vector<std::uint32_t> reached(kBlockPoints);
    reached.resize(
        list_distant_by_bounds(GetParam(), block, {bounds, limit}, center, -infinity, reached.data()));
    std::sort(reached.begin(), reached.end());
    EXPECT_EQ(std::adjacent_find(reached.begin(), reached.end()), reached.end());
    const std::vector<std::uint32_t> expected = list(Isa::scalar, block, center, limit, FloatFilter::off);
    EXPECT_TRUE(std::includes(reached.begin(), reached.end(), expected.begin(), expected.end()));
  }

  static std::vector<double> limits(const std::vector<double>& expected) {
    std::vector<double> all = {0.0};
    for (const double d2 : expected) {
      for (const double factor : {0.9, 1 - 1e-7, 1.0, 1 + 0x1p-52, 1 + 1e-7, 1 + 1e-6, 1.1})
        all.push_back(d2 * factor);
    }
    return all;
  }
};

TEST_P(DistanceParity, EqualsTheReferenceForFloat) {
  for (const TestCloud<float>& cloud : test::nasty_clouds<float>()) {
    SCOPED_TRACE(cloud.name);
    expect_parity(cloud.view(), middle(cloud.view()));
    expect_parity(Records<float>(cloud, 16).view(), middle(cloud.view()));
  }
}

TEST_P(DistanceParity, EqualsTheReferenceForDouble) {
  for (const TestCloud<double>& cloud : test::nasty_clouds<double>()) {
    SCOPED_TRACE(cloud.name);
    expect_parity(cloud.view(), middle(cloud.view()));
  }
}

TEST_P(DistanceParity, EqualsTheReferenceForEveryStrideAndTail) {
  for (std::size_t n = 1; n <= 3 * 16 + 1; ++n) {
    const TestCloud<float> cloud = test::gaussian<float>(n, n, 2, 30);
    for (const std::size_t stride : {12, 16, 20, 32, 48}) {
      SCOPED_TRACE(testing::Message() << n << " points, stride " << stride);
      expect_parity(Records<float>(cloud, stride).view(), middle(cloud.view()));
    }
    const TestCloud<double> doubles = test::gaussian<double>(n, n, 2, 30);
    expect_parity(Records<double>(doubles, 32).view(), middle(doubles.view()));
  }
}

TEST_P(DistanceParity, EqualsTheReferenceForEveryPositionOfABadPoint) {
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                       -std::numeric_limits<float>::infinity()};
  for (const std::size_t n : {1, 15, 16, 33, 50}) {
    for (std::size_t i = 0; i < 3 * n; ++i) {
      TestCloud<float> cloud = test::gaussian<float>(n, 5);
      cloud.xyz[i] = bad[i % 3];
      SCOPED_TRACE(testing::Message() << n << " points, coordinate " << i);
      expect_parity(Records<float>(cloud, 16).view(), {0.1, 0.2, 0.3, 1});
      expect_parity(Records<float>(cloud, 12).view(), {0.1, 0.2, 0.3, 1});
    }
  }
}

TEST_P(DistanceParity, EqualsTheReferenceForIndexLists) {
  const TestCloud<float> cloud = test::gaussian<float>(4000, 3);
  std::vector<std::int32_t> indices(4000);
  std::iota(indices.begin(), indices.end(), 0);
  std::shuffle(indices.begin(), indices.end(), std::mt19937_64(4));
  indices.resize(2777);
  indices.push_back(3999);  // the last point of the cloud: nothing may be read behind it
  for (const std::size_t stride : {12, 16, 32, 48}) {
    const Records<float> records(cloud, stride);
    PointView view = records.view();
    view.indices = indices.data();
    view.count = indices.size();
    SCOPED_TRACE(testing::Message() << "stride " << stride);
    expect_parity(view, middle(view));
  }
}

TEST_P(DistanceParity, EqualsTheReferenceForThePapersGroups) {
  for (const std::size_t n : {1, 15, 16, 17, 100, 1024, 1500, 3000}) {
    const TestCloud<float> cloud = test::gaussian<float>(n, n, 2, 30);
    constexpr std::size_t lanes = kGroupBytes / sizeof(float);
    std::vector<float> groups((n + lanes - 1) / lanes * 3 * lanes);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        groups[(i / lanes * 3 + axis) * lanes + i % lanes] = cloud.xyz[3 * i + axis];
    }
    PointView view = PointView::of(groups.data(), 12, n);
    view.order = PointOrder::groups;
    SCOPED_TRACE(testing::Message() << n << " points");
    expect_parity(view, middle(view));
    EXPECT_EQ(run(GetParam(), view, middle(view), 0, FloatFilter::reject),
              run(Isa::scalar, cloud.view(), middle(view), 0, FloatFilter::off));
    if (n > 20) expect_parity(view.slice(5, n - 9), middle(view));
  }
}

TEST_P(DistanceParity, EqualsTheReferenceForACentreThatIsNoFloat) {
  const TestCloud<float> cloud = test::gaussian<float>(100, 6);
  for (const double far : {3.4028235677973366e38, 1e39, 1e100})
    expect_parity(cloud.view(), {far, -far, 0, 1});
  // Floats as near to the centre as its rounding to one loses.
  TestCloud<float> around{"around 2^20", {}};
  for (int i = 0; i < 27; ++i)
    around.xyz.insert(around.xyz.end(), {0x1p20F + 0.125F * float(i % 3), 0x1p20F + 0.125F * float(i / 3 % 3),
                                         0x1p20F + 0.125F * float(i / 9)});
  for (const double lost : {0.0, 0x1p-20, 0.06, 0.0625, 0.07})
    expect_parity(around.view(), {0x1p20 + lost, 0x1p20 + 0.125 - lost, 0x1p20 + 0.25, 1});
}

TEST_P(DistanceParity, FloatRejectsWhatIsClearlyInside) {
  const TestCloud<float> cloud = test::gaussian<float>(1024, 3);
  const double greatest = run(Isa::scalar, cloud.view(), {}, 0, FloatFilter::off)[0];
  for (const double offset : {0.0, 0.3, 1e3}) {
    TestCloud<float> moved = cloud;
    for (float& c : moved.xyz)
      c += static_cast<float>(offset);
    const DistanceCenter center{offset, offset, offset, 1};
    const double found = run(GetParam(), moved.view(), center, greatest * 1.01, FloatFilter::reject)[0];
    EXPECT_LT(found, greatest * 1.001) << offset;
  }
}

TEST_P(DistanceParity, TheFilterComesBackOffWhereFloatsRejectLittleAndOnlyThere) {
  const TestCloud<float> cloud = test::gaussian<float>(kBlockPoints, 3);
  OctantScan all{{}, 0, FloatFilter::reject};
  scan_octants(GetParam(), cloud.view(), all);
  // The reference has no floats that could reject.
  EXPECT_EQ(all.filter, GetParam() == Isa::scalar ? FloatFilter::reject : FloatFilter::off);
  const double greatest = run(Isa::scalar, cloud.view(), {}, 0, FloatFilter::off)[0];
  OctantScan farthest{{}, greatest, FloatFilter::reject};
  scan_octants(GetParam(), cloud.view(), farthest);
  EXPECT_EQ(farthest.filter, FloatFilter::reject);
}

INSTANTIATE_TEST_SUITE_P(EveryUsableSet, DistanceParity, testing::ValuesIn(usable_isas()),
                         [](const auto& param) { return std::string(isa_name(param.param)); });

}  // namespace
}  // namespace pcl_bv::detail
