// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Threads that sleep between calls, whom nobody waits for unless they have begun: on a machine that is busy
// with other things a call then takes what it takes alone, where a barrier waits for the last thread to get a
// core.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace pcl_bv::internal {

class WorkerPool {
 public:
  /// The process's pool. Threads are started when they are first wanted and joined at exit; from then on
  /// calls do without. A fork has the pool but not its threads, and does without those.
  static WorkerPool& instance();

  /// Runs work(argument) here and on up to `helpers` other threads that find the time before it returns here;
  /// then waits for those. Nested calls do without helpers.
  void run(unsigned helpers, void (*work)(void*), void* argument);

  /// Whether this thread is inside run(), as caller or helper.
  static bool inside();

  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

 private:
  struct Task {
    void (*work)(void*);
    void* argument;
    unsigned wanted;  // helpers that may still join
    unsigned active;  // that have joined and not left
  };

  struct End {
    ~End();
    WorkerPool& pool;
  };

  WorkerPool();
  void end();
  void start(unsigned threads);
  Task* wanting();
  void serve();

  std::mutex mutex_;
  std::condition_variable work_, done_;
  std::vector<Task*> tasks_;
  std::vector<std::thread> threads_;
  bool ended_ = false;
  const int process_;
};

}  // namespace pcl_bv::internal
