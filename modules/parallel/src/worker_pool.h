// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A pool of threads that sleep between calls of WorkerPool::run(). run() waits only for threads that have
// begun to work. So on a busy machine run() takes hardly longer than the work would take on one thread. A
// barrier, in contrast, waits until the last thread gets a processor.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace pcl_bv::detail {

/// Marks the calling thread as inside a parallel region while the object lives. Objects must not be nested on
/// a thread. A forked child starts outside of any region.
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
  /// Returns the process's pool. Threads are started when first needed and joined at exit. Once the threads
  /// are joined, run() uses the calling thread alone. A forked child gets a new pool.
  static WorkerPool& instance();

  /// Runs work() on the calling thread and at the same time on at most `helpers` pool threads. The helpers
  /// are those that become free before work() returns on the calling thread. Then waits for the helpers. Must
  /// not be called inside a parallel region. If `work` forks and the child returns from `work`, throws
  /// std::logic_error in the child, because the results of the other threads are missing there.
  void run(unsigned helpers, const std::function<void()>& work);

  /// Makes at most `helpers` pool threads spin for new tasks instead of sleeping, until stop_spinning() has
  /// been called as often as start_spinning().
  void start_spinning(unsigned helpers);

  /// Cancels one call of start_spinning(). Does nothing if `pool` is the pool of the parent process.
  static void stop_spinning(WorkerPool* pool);

  /// Joins the threads. Later calls of run() use the calling thread alone.
  void end();

 private:
  struct Task {
    const std::function<void()>& work;
    unsigned wanted;               // number of helpers that may still join
    std::atomic<unsigned> active;  // number of helpers at work; changed with the lock held
  };

  void start(unsigned threads);
  void exclude_processor(int processor);
  Task* find_open_task();
  void serve();
  bool spin_for_task(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable work_, done_;
  std::vector<Task*> tasks_;
  std::vector<std::thread> threads_;
  bool ended_ = false;
  int avoided_ = -1;                          // processor that the threads avoid, or -1; guarded by mutex_
  unsigned spinning_ = 0, max_spinning_ = 0;  // threads that spin, and their maximum; guarded by mutex_
  std::uint64_t spin_request_count_ = 0;      // number of calls of start_spinning(); guarded by mutex_
  std::atomic<unsigned> spin_requests_{0};    // calls of start_spinning() not yet ended by stop_spinning()
  std::atomic<std::uint64_t> run_count_{0};   // number of calls of run()
};

}  // namespace pcl_bv::detail
