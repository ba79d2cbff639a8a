// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scheduling attributes of the pool's threads. By default a thread inherits its processors, nice value,
// scheduling policy and signal mask from the thread that starts it. That thread may belong to a device
// driver, be pinned to one core and have real-time priority. Pool threads therefore take processors, nice
// value and policy from the process's main thread, and block signals.
#pragma once

#include <csignal>
#include <thread>
#include <vector>

namespace pcl_bv::detail {

/// Returns the number of processors that the main thread may use, at least 1. `taskset`, cpusets and the main
/// thread's own affinity limit this number; the affinity of other threads does not.
unsigned process_processors();

/// Returns the processor that the calling thread runs on; negative if the system does not report it.
int current_processor();

/// Lets `threads` run on the main thread's processors except `avoided`. No processor is excluded if `avoided`
/// is negative or is the main thread's only processor.
void avoid_processor(int avoided, std::vector<std::thread>& threads);

/// Gives the calling thread the nice value and the scheduling policy of the main thread, or the policy
/// SCHED_OTHER if the main thread is real-time. Sets the processors of the calling thread as
/// avoid_processor() does. Attributes that the system refuses to set stay unchanged.
void adopt_main_thread_scheduling(int avoided);

/// Blocks signals in the calling thread while the object lives. Threads started meanwhile inherit this signal
/// mask, so signal handlers run on the host's threads. Signals of faults (SIGSEGV, ...) stay unblocked,
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
