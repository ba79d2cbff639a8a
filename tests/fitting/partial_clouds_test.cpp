// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Volumes around several clouds whose partial results were computed independently.

#include "pcl_bv/fitting/partial_clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "clouds.h"
#include "executions.h"
#include "fits.h"
#include "pcl_bv/fitting/fit.h"

namespace pcl_bv::detail {
namespace {

using test::TestCloud;

// Whether the volume uses the covariance, or can be one that uses it.
bool uses_sums(const Method& method) {
  return method.name == "obb-pca" || method.name == "best";
}

// Gaussian, on the walls of a box or in few places, with invalid points; the scale depends on the seed.
template <typename T>
TestCloud<T> random_cloud(std::size_t n, std::uint64_t seed) {
  TestCloud<T> cloud = test::gaussian<T>(n, seed, seed % 5 == 0 ? 1e-3 : 10, seed % 2 == 0 ? 0 : 1000);
  for (std::size_t i = 0; i < cloud.xyz.size(); ++i) {
    if (seed % 3 == 0) cloud.xyz[i] = std::clamp(cloud.xyz[i], T(-3), T(3));
    if (seed % 3 == 1) cloud.xyz[i] = std::round(cloud.xyz[i]);
  }
  for (std::size_t i = seed % 7; i < n; i += 11)
    cloud.xyz[3 * i] = std::numeric_limits<T>::quiet_NaN();
  return cloud;
}

// Cuts that make empty tiles, tiles of one point, tiles that store all points, and tiles with blocks.
std::vector<std::size_t> random_cuts(std::size_t points, std::size_t tiles, std::mt19937_64& random) {
  std::vector<std::size_t> cuts{0, points};
  while (cuts.size() < tiles + 1)
    cuts.push_back(random() % (points + 1));
  if (tiles > 3) cuts[2] = std::min(points, cuts[3] + 1);
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

template <typename T>
std::vector<Partial> independent_tiles(const TestCloud<T>& cloud, const std::vector<std::size_t>& cuts) {
  std::vector<Partial> tiles;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    tiles.emplace_back(PointView::of(cloud.xyz.data() + 3 * cuts[i], 3 * sizeof(T), cuts[i + 1] - cuts[i]));
  return tiles;
}

void expect_fits_of(const Partial& expected, const Partial& joined, const PointView& points,
                    const std::string& where) {
  EXPECT_EQ(joined.size(), expected.size()) << where;
  for (const Method& method : methods()) {
    if (!Partial::can_fit(method)) continue;
    AnyVolume volume, one;
    const EstimationResult result = test::take(joined.fit(method), volume);
    const EstimationResult whole = test::take(expected.fit(method), one);
    const std::string what = where + ", " + std::string(method.name);
    {
      SCOPED_TRACE(what);
      test::expect_same_result(result, whole);
    }
    EXPECT_EQ(verify(volume, points).outside, 0U) << what;
    if (uses_sums(method) && points.count > Partial::kMaxStored) {
      EXPECT_NEAR(pcl_bv::volume(volume), pcl_bv::volume(one), 1e-6 * pcl_bv::volume(one)) << what;
    } else {
      EXPECT_TRUE(volume == one) << what;
    }
  }
}

template <typename T>
class PartialClouds : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(PartialClouds, Scalars);

TYPED_TEST(PartialClouds, HaveTheVolumesOfOneCloudForAnyTiles) {
  for (std::uint64_t seed = 0; seed < (test::kFewCases ? 4 : 8); ++seed) {
    std::mt19937_64 random(seed);
    const std::size_t size = seed % 4 == 0 ? random() % 4097 : 4000 + random() % 6000;
    const TestCloud<TypeParam> cloud = random_cloud<TypeParam>(size, seed);
    const std::vector<std::size_t> cuts = random_cuts(size, 1 + random() % 12, random);
    expect_fits_of(Partial(cloud.view()), join_clouds(independent_tiles(cloud, cuts)), cloud.view(),
                   "seed " + std::to_string(seed));
  }
}

TYPED_TEST(PartialClouds, WithoutValidPointsAreEmpty) {
  const TestCloud<TypeParam> none{
      "nothing finite", std::vector<TypeParam>(3 * 5000, std::numeric_limits<TypeParam>::infinity())};
  const Partial tile(none.view());
  for (const std::size_t tiles : {0UL, 1UL, 3UL}) {
    const Partial joined = join_clouds(std::vector<Partial>(tiles, tile));
    EXPECT_EQ(joined.size(), 5000 * tiles);
    EXPECT_EQ(joined.fit(*find_method("hull")).status, EstimationStatus::no_valid_points);
    EXPECT_EQ(joined.fit(*find_method("obb-pca")).dropped, 5000 * tiles);
  }
}

TEST(PartialCloudsOfFloatsAndDoubles, HaveTheVolumesOfDoubles) {
  for (std::uint64_t seed = 0; seed < (test::kFewCases ? 2 : 6); ++seed) {
    std::mt19937_64 random(seed);
    const std::size_t size = seed % 4 == 0 ? random() % 4097 : 4000 + random() % 6000;
    const TestCloud<float> floats = random_cloud<float>(size, seed);
    const TestCloud<double> doubles{"as doubles", {floats.xyz.begin(), floats.xyz.end()}};
    const std::vector<std::size_t> cuts = random_cuts(size, 5, random);
    const std::vector<Partial> expected = independent_tiles(doubles, cuts);
    std::vector<Partial> mixed = independent_tiles(floats, cuts);
    for (std::size_t i = 0; i < mixed.size(); ++i)
      if (random() % 2 == 0 || i + 1 == mixed.size()) mixed[i] = expected[i];
    const Partial joined = join_clouds(mixed), of_doubles = join_clouds(expected);
    expect_fits_of(Partial(doubles.view()), joined, doubles.view(), "seed " + std::to_string(seed));
    if (expected.back().size() == 0) continue;  // all others can be floats
    for (const char* const name : {"obb-pca", "ellipsoid"})
      EXPECT_TRUE(*joined.fit(*find_method(name)) == *of_doubles.fit(*find_method(name))) << seed << name;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
