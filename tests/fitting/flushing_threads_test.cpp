// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A host that flushes denormals may have started OpenMP's threads before we use them.

#include <gtest/gtest.h>

#include <functional>
#include <latch>
#include <optional>
#include <thread>

#include "clouds.h"
#include "executions.h"
#include "fits.h"
#include "flush_to_zero.h"
#include "numbers.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv::detail {
namespace {

constexpr unsigned kThreads = 3;
thread_local std::optional<test::FlushToZero> flush_to_zero;

// Calls body() in a thread whose OpenMP threads flush denormals. The new thread has OpenMP threads of its own, so those
// of the other tests stay as they are. Each chunk waits for the others, so no thread gets two.
void with_flushing_threads(const std::function<void()>& body) {
  std::thread([&] {
    std::latch arrived(kThreads);
    for_each_chunk(OpenMP{kThreads}, kThreads, [&](std::size_t) {
      arrived.arrive_and_wait();
      flush_to_zero.emplace();
    });
    body();
  }).join();
}

// Zeros, and in each 1024th place a point of a sphere of denormal size.
test::TestCloud<float> denormal_spikes() {
  const test::TestCloud<double> directions = test::gaussian<double>(test::kThreadedPoints / 1024, 15);
  test::TestCloud<float> cloud{"spikes", std::vector<float>(3 * test::kThreadedPoints)};
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double* d = &directions.xyz[3 * i];
    for (std::size_t axis = 0; axis < 3; ++axis)
      cloud.xyz[3 * (1024 * i + 5) + axis] =
          static_cast<float>(1e-41 * d[axis] / std::hypot(d[0], d[1], d[2]));
  }
  return cloud;
}

TEST(FlushingThreads, LoseNoDenormalOfAKdop) {
  const test::TestCloud<float> cloud = denormal_spikes();
  for (const Isa isa : usable_isas()) {
    SCOPED_TRACE(isa_name(isa));
    Kdop expected, kdop;
    expected = *fit_kdop(cloud.view(), KdopSet::dop26(), {Serial{}, isa});
    ASSERT_GT(expected.max(0), 0);
    with_flushing_threads(
        [&] { kdop = *fit_kdop(cloud.view(), KdopSet::dop26(), {OpenMP{kThreads}, isa}); });
    EXPECT_EQ(test::bits(kdop), test::bits(expected));
  }
}

TEST(FlushingThreads, LoseNoDenormalOfASphere) {
  const test::TestCloud<float> cloud = denormal_spikes();
  const Sphere expected = *fit_sphere(cloud.view(), SphereMethod::epos26, {Serial{}, {}});
  ASSERT_GT(expected.radius(), 0);
  for (int round = 0; round < 10; ++round) {  // which thread meets a point that counts is chance
    Sphere sphere;
    with_flushing_threads(
        [&] { sphere = *fit_sphere(cloud.view(), SphereMethod::epos26, {OpenMP{kThreads}, {}}); });
    ASSERT_EQ(test::bits(sphere), test::bits(expected));
  }
}

}  // namespace
}  // namespace pcl_bv::detail
