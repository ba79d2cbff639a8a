// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Every method on random clouds of any magnitude, judged in rationals. PCL_BV_ENCLOSURE_CASES sets the number
// of clouds for each method and PCL_BV_ENCLOSURE_SEED the seed of the first one, for longer runs and to
// repeat one case.

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "any_magnitude.h"
#include "encloses.h"
#include "few_cases.h"
#include "numbers.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/volumes/pair_queries.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;
using test::AnyMagnitude;
using test::TestCloud;

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

// The seed of the case that runs, which a signal prints.
volatile std::sig_atomic_t running_seed = 0;

void print_seed(int signal) {
  std::fprintf(stderr, "signal %d: PCL_BV_ENCLOSURE_SEED=%d\n", signal, static_cast<int>(running_seed));
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

int failures() {
  return ::testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count();
}

// Calls check(random) for each case, until ten cases have failed. Prints the slowest case: none should take
// 100 ms.
template <typename Check>
void for_each_case(std::uint64_t cases, const Check& check) {
  using Clock = std::chrono::steady_clock;
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGTERM})
    std::signal(signal, print_seed);
  const std::uint64_t first = from_environment("PCL_BV_ENCLOSURE_SEED", 1);
  const std::uint64_t end = first + from_environment("PCL_BV_ENCLOSURE_CASES", cases);
  std::uint64_t slowest = first;
  Clock::duration longest{};
  int failed = 0;
  for (std::uint64_t seed = first; seed < end && failed < 10; ++seed) {
    SCOPED_TRACE("PCL_BV_ENCLOSURE_CASES=1 PCL_BV_ENCLOSURE_SEED=" + std::to_string(seed));
    running_seed = static_cast<std::sig_atomic_t>(seed);
    AnyMagnitude random(seed);
    const int before = failures();
    const Clock::duration taken = check(random);
    if (failures() > before) ++failed;
    if (taken <= longest) continue;
    longest = taken;
    slowest = seed;
  }
  std::printf("slowest: PCL_BV_ENCLOSURE_SEED=%d, %.2f ms\n", static_cast<int>(slowest),
              std::chrono::duration<double, std::milli>(longest).count());
}

// Calls use(cloud) with a random cloud of floats or of doubles.
template <typename Use>
auto with_cloud(AnyMagnitude& random, const Use& use) {
  return random.chance(0.3) ? use(random.cloud<float>()) : use(random.cloud<double>());
}

MethodOptions options_of(AnyMagnitude& random, const Method& method) {
  MethodOptions options;
  options.up = random.up();
  options.growth = static_cast<SphereGrowth>(random.below(3));
  if (method.shape == "prism" && random.chance(0.3)) options.concave_length = random.power(-1000, 300);
  return options;
}

void expect_finite(const AnyVolume& volume) {
  for (const double number : test::numbers(volume))
    ASSERT_TRUE(std::isfinite(number));
  for (const double number : {pcl_bv::volume(volume), surface_area(volume)})
    ASSERT_TRUE(number >= 0 && std::isfinite(number)) << number;
  ASSERT_TRUE(center(volume).allFinite());
  ASSERT_TRUE(aabb(volume).min().allFinite() && aabb(volume).max().allFinite());
  const Mesh mesh = pcl_bv::mesh(volume);
  for (const Vector3d& vertex : mesh.vertices)
    ASSERT_TRUE(vertex.allFinite());
  for (const auto& face : mesh.faces) {
    for (const std::int32_t i : face)
      ASSERT_TRUE(i >= 0 && static_cast<std::size_t>(i) < mesh.vertices.size());
  }
}

class Enclosure : public ::testing::TestWithParam<const Method*> {};

TEST_P(Enclosure, HoldsEveryPointOfAnyCloud) {
  const Method& method = *GetParam();
  for_each_case(test::kFewCases ? 100 : 1000, [&](AnyMagnitude& random) {
    return with_cloud(random, [&](const auto& cloud) {
      const MethodOptions options = options_of(random, method);
      const auto begin = std::chrono::steady_clock::now();
      const Fitted<AnyVolume> fitted = method.fit(cloud.view(), options);
      const auto taken = std::chrono::steady_clock::now() - begin;
      test::expect_encloses(*fitted, cloud.view());
      EXPECT_EQ(verify(*fitted, cloud.view()).outside, 0U);
      if (fitted.used > 0) expect_finite(*fitted);
      return taken;
    });
  });
}

std::vector<const Method*> every_method() {
  std::vector<const Method*> all;
  for (const Method& method : methods())
    all.push_back(&method);
  return all;
}

std::string name_of(const ::testing::TestParamInfo<const Method*>& info) {
  std::string name(info.param->name);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Of, Enclosure, ::testing::ValuesIn(every_method()), name_of);

// Expects that rays towards points of the cloud hit the volume, and that the volume is not farther away than
// the points. The vertices of a flat hull may be off by 2^-36 of its size.
template <typename T>
void expect_bounds(const AnyVolume& volume, const TestCloud<T>& cloud, const Vector3d& from) {
  const double distance = pcl_bv::distance(volume, from);
  ASSERT_GE(distance, 0);
  const double size = (aabb(volume).max() - aabb(volume).min()).maxCoeff();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Coordinates c = load_point(cloud.view(), i);
    if (!is_valid(c)) continue;
    const Vector3d p(c.x, c.y, c.z), direction = p - from;
    const double away = std::hypot(direction.x(), direction.y(), direction.z());
    ASSERT_LE(distance, away + 1e-9 * (away + size)) << "point " << i;
    const bool is_exact = from + direction == p && p - direction == from;
    ASSERT_TRUE(!is_exact || intersect(volume, from, direction)) << "point " << i;
  }
}

// Expects that bodies around one point overlap, and that their distances from a body around another point do
// not exceed the distance of the two points.
void expect_pair_bounds(const std::vector<ConvexBody>& bodies, const Coordinates& p, const ConvexBody& other,
                        const Vector3d& q) {
  const test::Rational squared = test::exact_squared_distance(q, p);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::size_t next = (i + 1) % bodies.size();
    ASSERT_TRUE(overlaps(bodies[i], bodies[next])) << methods()[i].name << " and " << methods()[next].name;
    const test::Rational distance(pcl_bv::distance(bodies[i], other));
    ASSERT_LE(distance * distance, squared) << methods()[i].name;
  }
}

// Distances of pairs are proven bounds.
TEST(Queries, OfVolumesOfAnyCloudKeepTheirBounds) {
  for_each_case(test::kFewCases ? 100 : 1000, [&](AnyMagnitude& random) {
    return with_cloud(random, [&](const auto& cloud) {
      const MethodOptions options = options_of(random, methods().front());
      const TestCloud<double> others = random.cloud<double>();
      const ConvexBody other(*find_method("dop14")->fit(others.view()));
      const Coordinates q = load_point(others.view(), 0);
      const auto begin = std::chrono::steady_clock::now();
      std::vector<ConvexBody> bodies;
      for (const Fitted<AnyVolume>& fitted : fit_methods(cloud.view(), every_method(), options)) {
        SCOPED_TRACE(methods()[bodies.size()].name);
        bodies.emplace_back(*fitted);
        if (fitted.used > 0 && is_valid(q)) expect_bounds(*fitted, cloud, {q.x, q.y, q.z});
      }
      for (std::size_t i = 0; i < cloud.size() && is_valid(q); ++i) {
        const Coordinates p = load_point(cloud.view(), i);
        if (is_valid(p)) expect_pair_bounds(bodies, p, other, {q.x, q.y, q.z});
      }
      return std::chrono::steady_clock::now() - begin;
    });
  });
}

}  // namespace
}  // namespace pcl_bv::detail
