// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Rows of the programs that measure one fit at a time: WORK/ISA/SCENE/LAYOUT/BAD/n:POINTS.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <vector>

#include "clouds.h"
#include "fits.h"
#include "peers.h"
#include "program.h"
#include "reading.h"
#include "timing.h"

namespace pcl_bv::bench {
using namespace detail;

template <typename Body>
benchmark::internal::Benchmark* add(const std::string& work, const std::string& how, const CloudName& cloud,
                                    Body body) {
  return benchmark::RegisterBenchmark((work + '/' + how + '/' + cloud.text()).c_str(), body)
      ->Unit(benchmark::kMicrosecond)
      ->ComputeStatistics(
          "min", [](const std::vector<double>& all) { return *std::min_element(all.begin(), all.end()); });
}

/// Without the scalar reference.
inline std::vector<Isa> simd_isas() {
  std::vector<Isa> isas = usable_isas();
  std::erase(isas, Isa::scalar);
  return isas;
}

template <typename Run>
void time_passes(benchmark::State& state, Run&& run) {
  for (auto _ : state)
    run();
}

/// A fit by its name in fits.h. `describe(state, fit, cloud)` adds counters.
template <typename Describe>
benchmark::internal::Benchmark* add_fit(const std::string& work, const Execution& execution,
                                        const std::string& how, const CloudName& name, Describe describe) {
  const Fit fit(work);
  return add(work, how, name, [=](benchmark::State& state) {
    Cloud& points = cloud(name);
    fit.check(points, execution);
    describe(state, fit, points);
    time_passes(state, [&] { fit(points, execution); });
  });
}

inline void add_fit(const std::string& work, Isa isa, const CloudName& name) {
  add_fit(work, {Serial{}, isa}, std::string(isa_name(isa)), name,
          [](benchmark::State&, const Fit&, Cloud&) {});
}

inline void add_fits(const std::vector<std::string>& works, const std::vector<Isa>& isas,
                     const CloudName& name) {
  for (const std::string& work : works) {
    for (const Isa isa : isas)
      add_fit(work, isa, name);
  }
}

inline void add_peer(const Peer& peer, const CloudName& name) {
  add(peer.name, "peer", name, [=](benchmark::State& state) {
    Cloud& points = cloud(name);
    if (!points.outside.contains(peer.name)) points.outside[peer.name] = peer.outside(points);
    time_passes(state, [&] { peer.run(points); });
    state.counters["outside"] = static_cast<double>(points.outside[peer.name]);
  });
}

/// How fast the bytes of a cloud can be read at all: "read-1-thread/best/...".
inline void add_reading(const CloudName& name, unsigned threads) {
  auto* const row =
      add("read-" + std::to_string(threads) + "-thread", "best", name, [=](benchmark::State& state) {
        const Reading reading(cloud(name), threads);
        time_passes(state, reading);
      });
  if (threads > 1) row->UseRealTime();
}

/// In turns (timing.h): what make_first(cloud) returns, and a fit.
/// COMPARISON/WORK/ISA/SCENE/LAYOUT/BAD/n:POINTS.
template <typename MakeFirst>
void add_comparison(const std::string& comparison, const Fit& fit, const Execution& execution,
                    const CloudName& name, const std::string& suffix, MakeFirst make_first) {
  const std::string row =
      comparison + '/' + fit.name() + '/' + std::string(isa_name(execution.isa)) + '/' + name.text() + suffix;
  add_turns(row, kPairs, [=](benchmark::State& state) {
    Cloud& points = cloud(name);
    fit.check(points, execution);
    compare(state, make_first(points), [&] { fit(points, execution); });
  });
}

/// A fit on one thread and on `threads` of them: "threads-2/...".
inline void add_threads(unsigned threads, const std::string& work, Isa isa, const CloudName& name) {
  const Fit fit(work);
  add_comparison("threads-" + std::to_string(threads), fit, {policy_of(threads), isa}, name, wait_policy(),
                 [=](const Cloud& points) { return [&points, fit, isa] {
                                              fit(points, {Serial{}, isa});
                                            }; });
}

}  // namespace pcl_bv::bench
