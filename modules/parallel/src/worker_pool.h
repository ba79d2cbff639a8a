// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Threads that sleep between calls, whom nobody waits for unless they have begun: on a machine that is busy
// with other things a call then takes what it takes alone, where a barrier waits for the last thread to get a
// core.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace pcl_bv::internal {

/// While it lives, this thread is inside a parallel call. Regions do not nest. A forked child is outside.
class ParallelRegion {
 public:
  ParallelRegion();
  ~ParallelRegion();
  ParallelRegion(const ParallelRegion&) = delete;
  ParallelRegion& operator=(const ParallelRegion&) = delete;

  static bool inside();
};

class WorkerPool {
 public:
  /// The process's pool. Threads are started when they are first wanted and joined at exit; from then on
  /// calls do without. A forked child has a pool of its own.
  static WorkerPool& instance();

  /// Runs work() here and on up to `helpers` other threads that find the time before it returns here;
  /// then waits for those. Not inside a parallel region. Throws std::logic_error in a child that `work`
  /// forked and that returns from it: what the other threads had begun is lost there.
  void run(unsigned helpers, const std::function<void()>& work);

  /// Joins the threads; calls do without from then on.
  void end();

 private:
  struct Task {
    const std::function<void()>& work;
    unsigned wanted;  // helpers that may still join
    unsigned active;  // that have joined and not left
  };

  void start(unsigned threads);
  Task* wanting();
  void serve();

  std::mutex mutex_;
  std::condition_variable work_, done_;
  std::vector<Task*> tasks_;
  std::vector<std::thread> threads_;
  bool ended_ = false;
};

}  // namespace pcl_bv::internal
