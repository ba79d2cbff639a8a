// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What every program of this folder does alike: its main(), and tiny runs, which show that no row has rotted.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "pcl_bv/parallel/execution.h"

namespace pcl_bv::bench {

/// PCL_BV_BENCH_TINY is set: every row runs once, on a part of its cloud. Names of rows stay as they are;
/// what is measured is worth nothing.
inline bool tiny() {
  return std::getenv("PCL_BV_BENCH_TINY") != nullptr;
}

/// As many points as a cloud of `points` has in this run.
inline std::size_t points_in_this_run(std::size_t points) {
  return tiny() ? std::min<std::size_t>(points, 2048) : points;
}

/// How often to run what is run a given number of times.
inline int times_in_this_run(int times) {
  return tiny() ? std::min(times, 2) : times;
}

/// Whether rows of several threads run on OpenMP's pool and not on ours: PCL_BV_BENCH_OPENMP=1.
inline bool on_openmp() {
  return std::getenv("PCL_BV_BENCH_OPENMP") != nullptr;
}

inline ParallelPolicy policy_of(unsigned threads) {
  if (threads == 1) return Serial{};
  return on_openmp() ? ParallelPolicy(OpenMP{threads}) : ParallelPolicy(Threads{threads});
}

/// "/wait:own", or on OpenMP's pool "/wait:default" or what OMP_WAIT_POLICY says: how threads wait for work,
/// part of the names of their rows.
inline std::string wait_policy() {
  const char* policy = std::getenv("OMP_WAIT_POLICY");
  return std::string("/wait:") + (!on_openmp() ? "own" : policy ? policy : "default");
}

/// Runs the rows registered so far.
inline int run_program(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc);
  std::string once = "--benchmark_min_time=0.00001";
  if (tiny()) arguments.insert(arguments.begin() + 1, once.data());
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace pcl_bv::bench
