// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/partial.h"
#include "pcl_bv/fitting/smallest_sphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <stdexcept>

#include "clouds.h"
#include "executions.h"
#include "fits.h"
#include "pcl_bv/fitting/fit.h"
#include "sources.h"

namespace pcl_bv::detail {
namespace {

using test::TestCloud;

std::vector<const Method*> served() {
  std::vector<const Method*> found;
  for (const Method& method : methods()) {
    if (Partial::can_fit(method)) found.push_back(&method);
  }
  return found;
}

// Those whose answer for parts is that for all points by definition, not only as a rule.
bool exact(const Method& method) {
  return method.name != "sphere-exact" && method.name != "obb-yaw" && method.name != "best";
}

std::vector<std::byte> bytes_of(const AnyVolume& volume) {
  std::vector<std::byte> bytes;
  const auto add = [&](const auto& value) {
    const auto* const first = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof value);
  };
  for (const Eigen::Vector3d& p : mesh(volume).vertices)
    add(p);
  add(pcl_bv::volume(volume));
  add(surface_area(volume));
  return bytes;
}

// Random cuts: some parts are empty, some of one point.
std::vector<Partial> parts_of(const PointView& cloud, std::size_t count, std::mt19937_64& random) {
  std::vector<std::size_t> cuts{0, cloud.count};
  while (cuts.size() < count + 1)
    cuts.push_back(random() % (cloud.count + 1));
  if (count > 3) cuts[2] = std::min(cloud.count, cuts[3] + 1);
  std::sort(cuts.begin(), cuts.end());
  std::vector<Partial> parts;
  for (std::size_t i = 0; i < count; ++i)
    parts.emplace_back(cloud.slice(cuts[i], cuts[i + 1] - cuts[i]));
  return parts;
}

// Any two, until one is left.
Partial merged_at_random(std::vector<Partial> parts, std::mt19937_64& random) {
  std::shuffle(parts.begin(), parts.end(), random);
  while (parts.size() > 1) {
    const std::size_t i = random() % (parts.size() - 1);
    parts[i].merge(parts[i + 1]);
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  }
  return parts.front();
}

template <typename T>
TestCloud<T> on_walls(std::size_t n, std::uint64_t seed) {
  TestCloud<T> cloud = test::gaussian<T>(n, seed);
  cloud.name = "on the walls of a box";
  for (T& x : cloud.xyz)
    x = std::clamp(x, T(-1), T(1));
  return cloud;
}

template <typename T>
TestCloud<T> on_sphere(std::size_t n, std::uint64_t seed) {
  TestCloud<T> cloud = test::gaussian<T>(n, seed);
  cloud.name = "on a sphere";
  for (std::size_t i = 0; i < n; ++i) {
    T* p = &cloud.xyz[3 * i];
    const T length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    for (int k = 0; k < 3; ++k)
      p[k] = p[k] / length + T(100);
  }
  return cloud;
}

template <typename T>
std::vector<TestCloud<T>> clouds() {
  std::vector<TestCloud<T>> all = {test::gaussian<T>(4096, 1), test::gaussian<T>(4097, 2),
                                   test::gaussian<T>(test::kEmulated ? 6000 : 40'000, 3, 5, 4e6),
                                   on_walls<T>(10'000, 4), on_sphere<T>(5000, 5)};
  TestCloud<T> lattice{"tilted lattice", {}}, holes = test::gaussian<T>(9000, 6);
  for (int i = 0; i < 7000; ++i)
    lattice.xyz.insert(lattice.xyz.end(), {T(i % 100), T(i / 100), T(i % 100 + i / 100)});
  for (std::size_t i = 0; i < holes.size(); i += 1 + i % 7)
    holes.xyz[3 * i + i % 3] = std::numeric_limits<T>::quiet_NaN();
  TestCloud<T> nothing{"nothing finite", std::vector<T>(3 * 5000, std::numeric_limits<T>::infinity())};
  TestCloud<T> equal{"equal points", std::vector<T>(3 * 5000, T(0.1))};
  TestCloud<T> cluster = on_walls<T>(300, 7);
  all.insert(all.end(), {lattice, holes, nothing, equal, cluster, TestCloud<T>{"empty", {}}});
  return all;
}

template <typename T>
class Partials : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Partials, Scalars);

TYPED_TEST(Partials, GiveTheBitsOfTheWholeHoweverItIsCut) {
  for (const TestCloud<TypeParam>& cloud : clouds<TypeParam>()) {
    std::mt19937_64 random(cloud.size());
    for (const std::size_t count : {2UL, 64UL}) {
      if (test::kFewCases && count == 2) continue;
      const Partial all = merged_at_random(parts_of(cloud.view(), count, random), random);
      EXPECT_EQ(all.size(), cloud.size());
      for (const Method* method : served()) {
        if (!exact(*method) && cloud.size() > Partial::kMaxStored) continue;
        AnyVolume expected, found;
        const EstimationResult whole = test::take(method->fit(cloud.view()), expected);
        const EstimationResult result = test::take(all.fit(*method), found);
        SCOPED_TRACE(cloud.name + ", " + std::string(method->name) + ", parts: " + std::to_string(count));
        test::expect_same_result(result, whole);
        EXPECT_TRUE(found == expected);
        EXPECT_TRUE(bytes_of(found) == bytes_of(expected));
      }
    }
  }
}

// The others have the bits of the whole, which holds them all.
TYPED_TEST(Partials, OfMethodsThatRoundEncloseAllPointsAndAreAsSmall) {
  for (const TestCloud<TypeParam>& cloud : clouds<TypeParam>()) {
    std::mt19937_64 random(cloud.size());
    const Partial all = merged_at_random(parts_of(cloud.view(), 3, random), random);
    for (const char* name : {"sphere-exact", "obb-yaw"}) {
      const Method* method = find_method(name);
      AnyVolume expected, found;
      expected = *method->fit(cloud.view());
      found = *all.fit(*method);
      EXPECT_EQ(verify(found, cloud.view()).outside, 0U) << cloud.name << ", " << method->name;
      // The centre of a sphere at 4e6 is rounded to 5e-10.
      EXPECT_NEAR(volume(found), volume(expected), 1e-9 * volume(expected)) << cloud.name << method->name;
    }
  }
}

// Each machine has a part, and none has all.
TYPED_TEST(Partials, FindTheSmallestSphereOfTheWholeByAskingTheParts) {
  for (const TestCloud<TypeParam>& cloud : clouds<TypeParam>()) {
    const PointView all = cloud.view();
    const std::size_t third = all.count / 3;
    const PointView parts[] = {all.slice(0, third), all.slice(third, 1), all.slice(third + 1, 0),
                               all.slice(third + 1, all.count - third - std::min<std::size_t>(1, all.count))};
    if (all.count == 0) continue;
    Partial merged;
    for (const PointView& part : parts)
      merged.merge(Partial(part));
    int questions = 0;
    std::vector<FarthestFinder> answers(std::begin(parts), std::end(parts));
    const auto ask = [&](const FarQuery& query, OctantPoints& found) {
      found = {};
      ++questions;
      for (FarthestFinder& part : answers) {
        OctantPoints own;
        part(query, own);
        update_farthest(own, found);
      }
      return std::any_of(found.begin(), found.end(),
                         [](const FarPoint& p) { return p.squared_distance >= 0; });
    };
    const auto whole = pcl_bv::fit_smallest_sphere(all);
    const auto sphere = fit_smallest_sphere(merged, ask);
    EXPECT_TRUE(AnyVolume(*sphere) == AnyVolume(*whole)) << cloud.name;
    EXPECT_EQ(sphere.used, whole.used) << cloud.name;
    EXPECT_EQ(sphere.rank, whole.rank) << cloud.name;
    EXPECT_EQ(sphere.certificate.support, whole.certificate.support) << cloud.name;
    EXPECT_EQ(sphere.certificate.passes, whole.certificate.passes) << cloud.name;
    EXPECT_EQ(questions, all.count > Partial::kMaxStored ? sphere.certificate.passes : 0) << cloud.name;
  }
}

TEST(FarthestFinder, RefusesAnIndexList) {
  const TestCloud<float> cloud = test::gaussian<float>(10, 15);
  const std::int32_t indices[] = {1, 2};
  EXPECT_THROW(FarthestFinder(PointView::of(cloud.xyz.data(), 12, 2, indices)), std::invalid_argument);
}

TYPED_TEST(Partials, HaveTheSameBytesWhateverTheOrderOfMerging) {
  for (const TestCloud<TypeParam>& cloud : clouds<TypeParam>()) {
    std::mt19937_64 random(7);
    const std::vector<std::byte> expected = Partial(cloud.view()).to_bytes();
    for (const std::size_t count : {2UL, 9UL, 40UL}) {
      const std::vector<Partial> parts = parts_of(cloud.view(), count, random);
      for (int order = 0; order < 3; ++order)
        EXPECT_TRUE(merged_at_random(parts, random).to_bytes() == expected) << cloud.name << ", " << count;
    }
  }
}

TYPED_TEST(Partials, SurviveBytes) {
  for (const TestCloud<TypeParam>& cloud : clouds<TypeParam>()) {
    const std::vector<std::byte> bytes = Partial(cloud.view()).to_bytes();
    const Partial read = Partial::from_bytes(bytes.data(), bytes.size());
    EXPECT_TRUE(read.to_bytes() == bytes) << cloud.name;
    for (const char* name : {"hull", "obb-pca"}) {
      AnyVolume expected, found;
      expected = *find_method(name)->fit(cloud.view());
      found = *read.fit(*find_method(name));
      EXPECT_TRUE(found == expected) << cloud.name;
    }
  }
}

TEST(Partial, DependsOnNoExecution) {
  const TestCloud<float> cloud = test::gaussian<float>(test::kThreadedPoints, 9);
  const std::vector<std::byte> expected = Partial(cloud.view()).to_bytes();
  for (const test::NamedExecution& e : test::every_execution())
    EXPECT_TRUE(Partial(cloud.view(), 0, e.execution).to_bytes() == expected) << e.name;
  const test::CopyingSource source(cloud);
  EXPECT_TRUE(Partial(source.view()).to_bytes() == expected);
}

TEST(Partial, OfAMillionPointsIsSmall) {
  const TestCloud<float> cloud = test::gaussian<float>(1'000'000, 10);
  EXPECT_LT(Partial(cloud.view()).to_bytes().size(), 64U << 10);
}

TEST(Partial, NumbersPointsFromItsFirstOnOrAsTheViewDoes) {
  const TestCloud<float> cloud = test::gaussian<float>(10'000, 11);
  const std::vector<std::byte> expected = Partial(cloud.view()).to_bytes();
  Partial numbered(PointView::of(cloud.xyz.data() + 3 * 2500, 12, 7500), 2500);
  numbered.merge(Partial(cloud.view().slice(0, 2500)));
  EXPECT_TRUE(numbered.to_bytes() == expected);
}

TEST(Partial, MayHaveGapsBetweenItsNumbers) {
  const TestCloud<float> cloud = test::gaussian<float>(9000, 12);
  Partial all(cloud.view().slice(0, 5000));
  all.merge(Partial(cloud.view().slice(5000, 4000), 1 << 20));
  for (const char* name : {"hull", "aabb", "obb-dito14"}) {
    AnyVolume expected, found;
    expected = *find_method(name)->fit(cloud.view());
    found = *all.fit(*find_method(name));
    EXPECT_TRUE(found == expected) << name;
  }
}

TEST(Partial, RefusesMethodsThatNeedAllPoints) {
  const TestCloud<float> cloud = test::gaussian<float>(5000, 13);
  const Partial all(cloud.view());
  for (const char* name :
       {"sphere-ritter", "sphere-epos6", "sphere-epos14", "sphere-epos26", "sphere-epos98", "obb-lshape"}) {
    AnyVolume volume;
    ASSERT_FALSE(Partial::can_fit(*find_method(name)));
    EXPECT_THROW(test::take(all.fit(*find_method(name)), volume), std::invalid_argument) << name;
  }
}

TEST(Partial, RefusesPointsTwiceAndKeepsWhatItHad) {
  const TestCloud<float> cloud = test::gaussian<float>(20'000, 14);
  const PointView view = cloud.view();
  Partial part(view.slice(3000, 9000));
  const std::vector<std::byte> before = part.to_bytes();
  const std::size_t overlaps[][2] = {{11'999, 5000}, {11'999, 1},  {0, 3001},   {0, 20'000},
                                     {5000, 1},      {5000, 2000}, {4096, 4096}};
  for (const auto& [first, count] : overlaps) {
    EXPECT_THROW(part.merge(Partial(view.slice(first, count))), std::invalid_argument) << first;
    EXPECT_TRUE(part.to_bytes() == before);
  }
  EXPECT_THROW(part.merge(part), std::invalid_argument);
  Partial few(view.slice(0, 10));
  EXPECT_THROW(few.merge(Partial(view.slice(9, 1))), std::invalid_argument);
}

TEST(Partial, RefusesIndexListsAndOtherScalars) {
  const TestCloud<float> cloud = test::gaussian<float>(10, 15);
  const std::int32_t indices[] = {1, 2};
  EXPECT_THROW(Partial(PointView::of(cloud.xyz.data(), 12, 2, indices)), std::invalid_argument);
  const TestCloud<double> other = test::gaussian<double>(10, 15);
  Partial part(cloud.view());
  EXPECT_THROW(part.merge(Partial(other.view(), 10)), std::invalid_argument);
  part.merge(Partial(PointView::of(other.xyz.data(), 24, 0)));
  EXPECT_EQ(part.size(), 10U);
}

TEST(Partial, OfNothingFitsNothing) {
  AnyVolume volume;
  for (const Method* method : served()) {
    EXPECT_EQ(test::take(Partial().fit(*method), volume).status, EstimationStatus::no_valid_points);
    EXPECT_TRUE(empty(volume)) << method->name;
  }
}

TEST(PartialBytes, AreRefusedIfAnyByteIsWrongOrMissing) {
  for (const std::size_t points : {20UL, 5000UL}) {
    const TestCloud<float> cloud = test::gaussian<float>(points, 16);
    const std::vector<std::byte> good = Partial(cloud.view()).to_bytes();
    for (std::size_t i = 0; i < good.size(); i += 1 + good.size() / 2000) {
      std::vector<std::byte> bad = good;
      bad[i] ^= std::byte{0x10};
      EXPECT_THROW(Partial::from_bytes(bad.data(), bad.size()), std::invalid_argument) << i;
      EXPECT_THROW(Partial::from_bytes(good.data(), i), std::invalid_argument) << i;
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
