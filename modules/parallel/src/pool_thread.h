// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What threads of our own are to the system: the process's, not the first caller's. A new thread inherits
// processors, scheduling and blocked signals of the thread that starts it, which may be a driver's thread
// pinned to one core with real-time priority.
#pragma once

#include <csignal>
#include <thread>
#include <vector>

namespace pcl_bv::internal {

/// Processors that the main thread may use, at least 1: `taskset` and cgroups count, and so does a main
/// thread that pins itself; what other threads do to themselves does not.
unsigned process_processors();

/// The processor that the calling thread runs on; negative if the system does not say.
int own_processor();

/// Keeps threads from a processor where the main thread may use others; a negative one is none.
void avoid_processor(int avoided, std::vector<std::thread>& threads);

/// Gives the calling thread the processors but the avoided one, as above, the policy and the nice value of
/// the main thread; the ordinary policy where the main thread is real-time. What the system refuses stays as
/// it is.
void schedule_as_process(int avoided);

/// While it lives threads are started with all signals blocked, so that handlers run on the host's threads.
/// But a fault is always handled by the thread that commits it: were its signal blocked, the process would
/// end without the host's handler.
class SignalsBlocked {
 public:
  SignalsBlocked();
  ~SignalsBlocked();
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t before_;
};

}  // namespace pcl_bv::internal
