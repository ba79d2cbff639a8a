// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Threads that sleep between calls, whom nobody waits for unless they have begun: on a machine that is busy
// with other things a call then takes what it takes alone, where a barrier waits for the last thread to get a
// core.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
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

  /// From now on up to so many threads look for work without sleeping, until let_sleep() was called as often.
  void stay_awake(unsigned helpers);

  /// Of the pool that is the process's, and not of its parent's.
  static void let_sleep(WorkerPool* pool);

  /// Joins the threads; calls do without from then on.
  void end();

 private:
  struct Task {
    const std::function<void()>& work;
    unsigned wanted;               // helpers that may still join
    std::atomic<unsigned> active;  // that have joined and not left; changed with the lock
  };

  void start(unsigned threads);
  void avoid(int processor);
  Task* wanting();
  void serve();
  bool look_out(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable work_, done_;
  std::vector<Task*> tasks_;
  std::vector<std::thread> threads_;
  bool ended_ = false;
  int avoided_ = -1;                         // the processor that the threads keep from; with the lock
  unsigned looking_out_ = 0, lookouts_ = 0;  // threads that do, and may; with the lock
  std::uint64_t wakes_ = 0;                  // calls of stay_awake(); with the lock
  std::atomic<unsigned> awake_{0};           // those not yet ended
  std::atomic<std::uint64_t> offers_{0};     // calls of run()
};

}  // namespace pcl_bv::internal
