// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Short timings beside those of Google Benchmark: to choose between ways, and to compare two of them in
// turns.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "program.h"

namespace pcl_bv::bench {
using namespace detail;

template <typename Run>
double seconds(Run&& run, int times) {
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < times; ++i)
    run();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / times;
}

/// How often to run what is short, so that reading the clock does not count: 100 us in all.
template <typename Run>
int times_for(Run&& run) {
  double once = seconds(run, 1);
  if (once < 1e-3) once = std::min(once, seconds(run, 1));
  return once > 100e-6 ? 1 : static_cast<int>(100e-6 / std::max(once, 1e-9)) + 1;
}

inline constexpr int kPairs = 30;

/// Runs both in turns, the order changing, once per iteration of `state` (manual time: the second's).
/// Counters: the time of the first over that of the second as median of the pairs (`ratio`), and the two
/// minima in microseconds, whose ratio other work on the machine disturbs less.
template <typename First, typename Second>
void compare(benchmark::State& state, First&& first, Second&& second) {
  const int first_times = times_for(first), second_times = times_for(second);
  std::vector<double> ratios;
  double least_first = 1e9, least_second = 1e9;
  for (auto _ : state) {
    const bool swapped = ratios.size() % 2 == 1;
    double a = swapped ? 0 : seconds(first, first_times);
    const double b = seconds(second, second_times);
    if (swapped) a = seconds(first, first_times);
    ratios.push_back(a / b);
    least_first = std::min(least_first, a);
    least_second = std::min(least_second, b);
    state.SetIterationTime(b);
  }
  std::nth_element(ratios.begin(), ratios.begin() + ratios.size() / 2, ratios.end());
  state.counters["ratio"] = ratios[ratios.size() / 2];
  state.counters["first_us"] = 1e6 * least_first;
  state.counters["second_us"] = 1e6 * least_second;
}

/// A row whose body calls compare() or times itself in another way, `times` iterations.
template <typename Body>
void add_turns(const std::string& row, int times, Body body) {
  benchmark::RegisterBenchmark(row.c_str(), body)
      ->Iterations(times_in_this_run(times))
      ->Repetitions(1)
      ->UseManualTime()
      ->Unit(benchmark::kMicrosecond);
}

}  // namespace pcl_bv::bench
