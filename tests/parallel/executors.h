// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Executors as hosts may have them.
#pragma once

#include <functional>
#include <thread>
#include <vector>

#include "pcl_bv/parallel/policy.h"

namespace pcl_bv::test {

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

}  // namespace pcl_bv::test
