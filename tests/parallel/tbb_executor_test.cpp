// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// TBB's threads as an executor.

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <string>

#include "executors.h"
#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv::detail {
namespace {

const Executor on_tbb{4, [](std::size_t tasks, const std::function<void(std::size_t)>& task) {
                        tbb::parallel_for(std::size_t{0}, tasks, task);
                      }};

TEST(TbbExecutor, GivesTheOrderOfOneThread) {
  const auto map = [](std::size_t chunk) { return "<" + std::to_string(chunk) + ">"; };
  const auto merge = [](std::string& all, std::string part) { all += part; };
  const std::string expected = reduce_chunks(Serial{}, 1000, std::string("start"), map, merge);
  for (int round = 0; round < 100; ++round)
    ASSERT_EQ(reduce_chunks(on_tbb, 1000, std::string("start"), map, merge), expected) << "round " << round;
}

TEST(TbbExecutor, BodiesMayUseTbbThemselves) {
  std::atomic<int> calls{0}, inner{0};
  thread_local int depth = 0;
  std::atomic<int> deep{0};
  for_each_chunk(on_tbb, 200, [&](std::size_t) {
    if (++depth > 1) ++deep;
    tbb::parallel_for(0, 50, [&](int) { ++inner; });
    --depth;
    ++calls;
  });
  EXPECT_EQ(calls, 200);
  EXPECT_EQ(inner, 200 * 50);
  EXPECT_EQ(deep, 0) << "a body began inside another one";
}

TEST(TbbExecutor, RethrowsTheExceptionOfTheLowestChunk) {
  test::expect_exception_of_lowest_chunk(on_tbb);
}

}  // namespace
}  // namespace pcl_bv::detail
