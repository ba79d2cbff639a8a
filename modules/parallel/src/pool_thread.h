// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scheduling attributes of the pool's threads. By default a thread inherits processors, scheduling policy and
// signal mask from the thread that starts it, which may be a driver's thread, pinned to one core with
// real-time priority. Pool threads take processors and policy from the process's main thread instead, and
// block signals.
#pragma once

#include <csignal>
#include <thread>
#include <vector>

namespace pcl_bv::detail {

/// Returns the number of processors that the main thread may use, at least 1. `taskset`, cpusets and the main
/// thread's own affinity limit it; the affinity of other threads does not.
unsigned process_processors();

/// Returns the processor that the calling thread runs on; negative if the system does not report it.
int current_processor();

/// Excludes processor `avoided` from the affinity of `threads`, unless it is the main thread's only
/// processor. A negative `avoided` excludes none.
void avoid_processor(int avoided, std::vector<std::thread>& threads);

/// Gives the calling thread the main thread's processors without `avoided` (as avoid_processor() does), nice
/// value and scheduling policy. If the main thread is real-time, the policy is SCHED_OTHER. Attributes that
/// the system refuses to set stay unchanged.
void adopt_main_thread_scheduling(int avoided);

/// Blocks signals in the calling thread while the object lives, so that threads started meanwhile inherit the
/// mask and signal handlers run on the host's threads. Signals of faults (SIGSEGV, ...) stay unblocked,
/// because the faulting thread itself handles them. If they were blocked, the process would end without
/// calling the host's handler.
class SignalsBlocked {
 public:
  SignalsBlocked();
  ~SignalsBlocked();
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t before_;
};

}  // namespace pcl_bv::detail
