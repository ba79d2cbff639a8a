// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/parallel/for_each_chunk.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <latch>
#include <set>
#include <string>
#include <thread>

#include "executors.h"

namespace pcl_bv::detail {
namespace {

std::vector<ParallelPolicy> policies() {
  std::vector<ParallelPolicy> all = {Serial{}};
  for (const unsigned threads : {0U, 1U, 2U, 3U, 7U}) {
    all.emplace_back(Threads{threads});
    all.emplace_back(OpenMP{threads});
    all.emplace_back(Executor{threads, test::run_on_threads});
    all.emplace_back(Executor{threads, test::run_one_after_another});
  }
  return all;
}

TEST(ForEachChunk, CallsEachChunkOnce) {
  for (const ParallelPolicy& policy : policies()) {
    for (const std::size_t chunks : {0, 1, 2, 5, 100}) {
      std::vector<std::atomic<int>> calls(chunks);
      for_each_chunk(policy, chunks, [&](std::size_t chunk) { ++calls.at(chunk); });
      for (const auto& count : calls)
        EXPECT_EQ(count, 1);
    }
  }
}

TEST(ForEachRun, HandsOutEachItemOnceInRunsOfTheStatedLength) {
  for (const ParallelPolicy& policy : policies()) {
    for (const std::size_t items : {0, 1, 7, 8, 9, 801}) {
      std::vector<std::atomic<int>> calls(items);
      for_each_range(policy, items, 8, [&](std::size_t begin, std::size_t end) {
        EXPECT_EQ(end - begin, std::min<std::size_t>(8, items - begin));
        for (std::size_t i = begin; i < end; ++i)
          ++calls.at(i);
      });
      for (const auto& count : calls)
        EXPECT_EQ(count, 1);
    }
  }
}

TEST(ForEachChunk, RunsInTheCallingThreadWhenSerial) {
  std::set<std::thread::id> threads;
  for_each_chunk(Serial{}, 10, [&](std::size_t) { threads.insert(std::this_thread::get_id()); });
  EXPECT_EQ(threads, std::set{std::this_thread::get_id()});
}

TEST(ForEachChunk, TriesEveryChunkAndRethrowsTheExceptionOfTheLowest) {
  for (const ParallelPolicy& policy : policies())
    test::expect_exception_of_lowest_chunk(policy);
}

TEST(ForEachChunk, DoesNotNest) {
  for (const ParallelPolicy& policy : policies()) {
    std::atomic<int> strangers{0};
    for_each_chunk(policy, 8, [&](std::size_t) {
      const auto outer = std::this_thread::get_id();
      for_each_chunk(policy, 8,
                     [&](std::size_t) { strangers += std::this_thread::get_id() != outer ? 1 : 0; });
    });
    // With one thread there is no parallel region to nest in; with more, the inner loop must stay where it
    // is.
    EXPECT_EQ(strangers, 0);
  }
}

// The only thread of the pool is held by another caller: a busy machine.
TEST(ForEachChunk, OnOwnThreadsWaitsForNoneThatHasNotBegun) {
  std::latch both_begun(2), released(1);
  std::thread other([&] {
    for_each_chunk(Threads{2}, 2, [&](std::size_t) {
      both_begun.arrive_and_wait();
      released.wait();
    });
  });
  both_begun.wait();
  std::atomic<int> calls{0};
  for_each_chunk(Threads{2}, 10, [&](std::size_t) { ++calls; });
  EXPECT_EQ(calls, 10);
  released.count_down();
  other.join();
}

TEST(ForEachChunk, ServesManyCallersAtATime) {
  std::atomic<int> calls{0};
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 8; ++caller) {
    callers.emplace_back([&] {
      for (int round = 0; round < 200; ++round)
        for_each_chunk(Threads{3}, 5, [&](std::size_t) { ++calls; });
    });
  }
  for (std::thread& caller : callers)
    caller.join();
  EXPECT_EQ(calls, 8 * 200 * 5);
}

TEST(SpinningThreads, DoCallsThatFollowOneAnother) {
  for (const ParallelPolicy& policy : policies()) {
    const SpinningThreads awake(policy);
    const SpinningThreads twice(policy);
    for (std::size_t call = 0; call < 200; ++call) {
      std::vector<std::size_t> squares(5);
      for_each_chunk(policy, squares.size(), [&](std::size_t i) {
        const SpinningThreads inside(policy);
        squares[i] = i * call;
      });
      EXPECT_EQ(squares, (std::vector<std::size_t>{0, call, 2 * call, 3 * call, 4 * call}));
    }
  }
}

TEST(SpinningThreads, WorkForWhoeverCallsAndSleepAfterwards) {
  std::atomic<std::size_t> calls{0};
  const auto work = [&] {
    for (int i = 0; i < 50; ++i) {
      const SpinningThreads awake(Threads{4});
      for_each_chunk(Threads{3}, 6, [&](std::size_t) { ++calls; });
      if (i % 10 == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(3));  // longer than they stay awake
    }
  };
  {
    std::vector<std::jthread> callers;
    for (int i = 0; i < 4; ++i)
      callers.emplace_back(work);
  }
  EXPECT_EQ(calls, 4U * 50 * 6);
  for_each_chunk(Threads{4}, 6, [&](std::size_t) { ++calls; });
  EXPECT_EQ(calls, 4U * 50 * 6 + 6);
}

TEST(ReduceChunks, SameOrderForAnyThreadCount) {
  const auto map = [](std::size_t chunk) { return "<" + std::to_string(chunk) + ">"; };
  const auto merge = [](std::string& all, std::string part) { all += part; };
  const std::string expected = reduce_chunks(Serial{}, 40, std::string("start"), map, merge);
  EXPECT_EQ(expected.substr(0, 11), "start<0><1>");
  for (const ParallelPolicy& policy : policies()) {
    EXPECT_EQ(reduce_chunks(policy, 40, std::string("start"), map, merge), expected);
  }
}

TEST(LimitThreads, NeverRaisesAndNeverReachesZero) {
  EXPECT_EQ(thread_count(limit_threads(OpenMP{4}, 2)), 2U);
  EXPECT_EQ(thread_count(limit_threads(Threads{4}, 9)), 4U);
  EXPECT_EQ(thread_count(limit_threads(Threads{4}, 0)), 1U);
  EXPECT_EQ(thread_count(limit_threads(Serial{}, 9)), 1U);
}

}  // namespace
}  // namespace pcl_bv::detail
