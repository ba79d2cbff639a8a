// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where a computation runs: its threads and its instruction set.
#pragma once

#include <cstddef>
#include <functional>
#include <type_traits>
#include <utility>
#include <variant>

#include "pcl_bv/points/isa.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Runs on the calling thread only.
struct Serial {};

/// Runs on OpenMP's thread pool, which the rest of the program may use as well.
///
/// `threads` 0 means all processors that the calling thread may use. A parallel region ends only after each
/// of its threads has run, so on a busy machine the region waits until the last thread gets a processor. Do
/// not use this policy in a forked child whose parent has used OpenMP, because GNU's libgomp then waits
/// forever.
struct OpenMP {
  unsigned threads = 0;
};

/// Runs on the library's own thread pool. The threads of the pool sleep between parallel regions. A parallel
/// region waits only for threads that have begun to work, so on a busy machine the region is never much
/// slower than on one thread.
///
/// `threads` 0 means all processors that the process's main thread may use. A forked child gets a new pool. A
/// pool thread takes the processors, the nice value and the scheduling policy that the process's main thread
/// has when the pool thread starts. It does not matter which thread starts the pool thread. If the main
/// thread is real-time, pool threads use SCHED_OTHER. Pool threads avoid the caller's processor while the
/// caller works there. Pool threads block signals, except signals of faults such as SIGSEGV, so that the
/// host's threads handle signals. Programs that need threads with other attributes pass an Executor.
struct Threads {
  unsigned threads = 0;
};

/// Runs on threads of the host program.
///
/// `run(tasks, task)` should call each of task(0) ... task(tasks - 1) once, on any threads, concurrently or
/// one after another, and return when these calls have returned. `tasks` is at most `threads`; `threads` 0
/// means as many as `Threads{}` uses. With TBB: `[](std::size_t tasks, const auto& task) {
/// tbb::parallel_for(std::size_t{0}, tasks, task); }`.
///
/// The thread that called `run` completes the work of tasks that `run` has not called. Calls of task() after
/// the end of the parallel region have no effect. If `run` throws, the exception is rethrown when all tasks
/// that have begun have ended. In this case some of the work may not have been done.
struct Executor {
  unsigned threads = 0;
  std::function<void(std::size_t tasks, const std::function<void(std::size_t)>& task)> run;
};

/// Selects the threads on which a parallel region runs.
using ParallelPolicy = std::variant<Serial, OpenMP, Threads, Executor>;

/// Returns the number of threads that the policy would use, at least 1. Throws std::invalid_argument for an
/// Executor without `run`.
unsigned thread_count(const ParallelPolicy& policy);

/// Returns the same policy with at most `threads` threads (0 is treated as 1). For one thread this is Serial.
/// Throws like thread_count().
ParallelPolicy limit_threads(const ParallelPolicy& policy, std::size_t threads);

/// The threads and the instruction set of a computation. Neither choice changes a bit of the result.
///
/// A policy converts to an Execution, so a function that takes an Execution also takes `Threads{4}`.
struct Execution {
  Execution() = default;

  /// By default, `instructions` is the set to which Isa::automatic resolves in this call; see UsableIsa.
  /// Copies of the Execution keep the resolved set.
  template <typename Policy, typename = std::enable_if_t<std::is_convertible_v<Policy, ParallelPolicy>>>
  Execution(Policy policy, UsableIsa instructions = {}) : parallel(std::move(policy)), isa(instructions) {}

  ParallelPolicy parallel = Serial{};  ///< The threads.
  UsableIsa isa;                       ///< The instruction set. Default: the set that Isa::automatic selects.
};

}  // namespace pcl_bv
