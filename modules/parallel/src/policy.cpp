// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Thread counts of policies.

#include "pcl_bv/parallel/policy.h"

#include <omp.h>

#include <algorithm>

namespace pcl_bv {
namespace {

// Follows the process's CPU affinity, unlike std::thread::hardware_concurrency.
unsigned or_all(unsigned threads) {
  return threads != 0 ? threads : static_cast<unsigned>(omp_get_num_procs());
}

}  // namespace

unsigned thread_count(const ParallelPolicy& policy) {
  if (const auto* openmp = std::get_if<OpenMP>(&policy)) return or_all(openmp->threads);
  if (const auto* threads = std::get_if<Threads>(&policy)) return or_all(threads->threads);
  return 1;
}

ParallelPolicy limit_threads(const ParallelPolicy& policy, unsigned threads) {
  const unsigned limited = std::max(1U, std::min(threads, thread_count(policy)));
  if (limited == 1) return Serial{};
  if (std::holds_alternative<OpenMP>(policy)) return OpenMP{limited};
  return Threads{limited};
}

}  // namespace pcl_bv
