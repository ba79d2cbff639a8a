// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/parallel/execution.h"

#include <omp.h>

#include <algorithm>
#include <stdexcept>

#include "pool_thread.h"

namespace pcl_bv {
using namespace detail;

unsigned thread_count(const ParallelPolicy& policy) {
  const auto or_all = [](unsigned threads, auto all) {
    return threads != 0 ? threads : static_cast<unsigned>(all());
  };
  // OpenMP's threads inherit the processor affinity of the calling thread, hence omp_get_num_procs().
  if (const auto* openmp = std::get_if<OpenMP>(&policy)) return or_all(openmp->threads, omp_get_num_procs);
  if (const auto* threads = std::get_if<Threads>(&policy))
    return or_all(threads->threads, detail::process_processors);
  const auto* executor = std::get_if<Executor>(&policy);
  if (executor == nullptr) return 1;
  if (!executor->run)
    throw std::invalid_argument("Executor::run is empty; it must be a function that runs tasks");
  return or_all(executor->threads, detail::process_processors);
}

ParallelPolicy limit_threads(const ParallelPolicy& policy, std::size_t threads) {
  const auto limited = static_cast<unsigned>(std::clamp<std::size_t>(threads, 1, thread_count(policy)));
  if (limited == 1) return Serial{};
  if (std::holds_alternative<OpenMP>(policy)) return OpenMP{limited};
  if (const auto* executor = std::get_if<Executor>(&policy)) return Executor{limited, executor->run};
  return Threads{limited};
}

}  // namespace pcl_bv
