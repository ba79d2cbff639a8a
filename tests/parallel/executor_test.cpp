// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What is special about an executor of the host's; for_each_chunk_test.cpp claims of it what holds for every
// policy.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <latch>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "executors.h"
#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv::detail {
namespace {

using test::Task;

TEST(Executor, ItsThreadsWorkSideBySide) {
  std::latch all(3);
  std::mutex mutex;
  std::set<std::thread::id> threads;
  for_each_chunk(Executor{3, test::run_on_threads}, 3, [&](std::size_t) {
    all.arrive_and_wait();
    const std::lock_guard lock(mutex);
    threads.insert(std::this_thread::get_id());
  });
  EXPECT_EQ(threads.size(), 3U);
  EXPECT_EQ(threads.count(std::this_thread::get_id()), 0U);
}

TEST(Executor, GetsAsManyTasksAsItHasThreadsButNoMoreThanChunks) {
  std::size_t got = 0;
  const auto count = [&](std::size_t tasks, const Task&) { got = tasks; };
  for_each_chunk(Executor{4, count}, 100, [](std::size_t) {});
  EXPECT_EQ(got, 4U);
  for_each_chunk(Executor{4, count}, 2, [](std::size_t) {});
  EXPECT_EQ(got, 2U);
  for_each_chunk(limit_threads(Executor{9, count}, 3), 100, [](std::size_t) {});
  EXPECT_EQ(got, 3U);
}

TEST(Executor, WhatItLeavesOutTheCallerDoes) {
  std::multiset<std::size_t> done;
  for_each_chunk(Executor{4, [](auto&&...) {}}, 5, [&](std::size_t chunk) { done.insert(chunk); });
  EXPECT_EQ(done, (std::multiset<std::size_t>{0, 1, 2, 3, 4}));
}

// A later call keeps its chunks where the first one had them: there the late task would find them.
TEST(Executor, ATaskThatComesWhenItsCallIsOverDoesNothing) {
  Task late;
  std::multiset<std::thread::id> threads;
  const auto run = [&](std::size_t, const Task& task) {
    if (late) std::jthread(late, 0).join();
    late = task;
  };
  for (int call = 0; call < 2; ++call)
    for_each_chunk(Executor{2, run}, 5, [&](std::size_t) { threads.insert(std::this_thread::get_id()); });
  EXPECT_EQ(threads.count(std::this_thread::get_id()), 10U);
}

/// Starts one task, and comes back when it has begun its first chunk, which lasts longer.
class StartsOne {
 public:
  void begun() {
    if (begun_.try_wait()) return;
    begun_.count_down();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  void start(const Task& task) {
    thread_ = std::jthread(task, 0);
    begun_.wait();
  }

 private:
  std::latch begun_{1};
  std::jthread thread_;
};

TEST(Executor, TasksThatHaveBegunAreWaitedForWhenItReturnsEarly) {
  StartsOne one;
  std::atomic<int> done{0};
  for_each_chunk(Executor{2, [&](std::size_t, const Task& task) { one.start(task); }}, 5, [&](std::size_t) {
    one.begun();
    ++done;
  });
  EXPECT_EQ(done, 5);
}

TEST(Executor, WhatItThrowsIsThrownOnWhenTasksThatHaveBegunHaveEnded) {
  StartsOne one;
  std::atomic<int> inside{0};
  const auto run = [&](std::size_t, const Task& task) {
    one.start(task);
    throw std::runtime_error("no more threads");
  };
  EXPECT_THROW(for_each_chunk(Executor{2, run}, 5,
                              [&](std::size_t) {
                                ++inside;
                                one.begun();
                                --inside;
                              }),
               std::runtime_error);
  EXPECT_EQ(inside, 0);
}

// As TBB's threads do while they wait.
TEST(Executor, ATaskInsideABodyWorksNotBelowIt) {
  Task again;
  int depth = 0, deepest = 0, calls = 0;
  const auto run = [&](std::size_t, const Task& task) { (again = task)(0); };
  for_each_chunk(Executor{2, run}, 5, [&](std::size_t) {
    deepest = std::max(deepest, ++depth);
    again(1);
    --depth;
    ++calls;
  });
  EXPECT_EQ(deepest, 1);
  EXPECT_EQ(calls, 5);
}

TEST(Executor, WithoutAFunctionIsRefused) {
  const Executor none{2, {}};
  EXPECT_THROW(thread_count(none), std::invalid_argument);
  EXPECT_THROW(limit_threads(none, 1), std::invalid_argument);
  EXPECT_THROW(for_each_chunk(none, 5, [](std::size_t) {}), std::invalid_argument);
}

}  // namespace
}  // namespace pcl_bv::detail
