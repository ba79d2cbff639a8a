// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Executors as hosts may have them, and what holds on all policies.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv::test {
using namespace detail;

using Task = std::function<void(std::size_t)>;

/// A thread for each task.
inline void run_on_threads(std::size_t tasks, const Task& task) {
  std::vector<std::jthread> threads;
  for (std::size_t i = 0; i < tasks; ++i)
    threads.emplace_back(task, i);
}

/// Backwards, in the calling thread.
inline void run_one_after_another(std::size_t tasks, const Task& task) {
  while (tasks-- > 0)
    task(tasks);
}

/// Every chunk is tried, and the exception of the lowest one that throws comes back.
inline void expect_exception_of_lowest_chunk(const ParallelPolicy& policy) {
  std::atomic<int> calls{0};
  try {
    for_each_chunk(policy, 50, [&](std::size_t chunk) {
      ++calls;
      if (chunk % 7 == 3) throw std::runtime_error(std::to_string(chunk));
    });
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "3");
  }
  EXPECT_EQ(calls, 50);
}

}  // namespace pcl_bv::test
