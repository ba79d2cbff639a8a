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

namespace pcl_bv::bench {

template <typename Body>
benchmark::internal::Benchmark* add(const std::string& work, const std::string& isa, const CloudName& cloud,
                                    Body body) {
  return benchmark::RegisterBenchmark((work + '/' + isa + '/' + cloud.text()).c_str(), body)
      ->Unit(benchmark::kMicrosecond)
      ->ComputeStatistics(
          "min", [](const std::vector<double>& all) { return *std::min_element(all.begin(), all.end()); });
}

template <typename Run>
void time_passes(benchmark::State& state, const Cloud& cloud, Run&& run) {
  for (auto _ : state)
    run();
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cloud.view.count));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(cloud.bytes));
}

inline void add_peer(const Peer& peer, const CloudName& name) {
  add(peer.name, "peer", name, [=](benchmark::State& state) {
    Cloud& points = cloud(name);
    if (!points.outside.contains(peer.name)) points.outside[peer.name] = peer.outside(points);
    time_passes(state, points, [&] { peer.run(points); });
    state.counters["outside"] = static_cast<double>(points.outside[peer.name]);
  });
}

}  // namespace pcl_bv::bench
