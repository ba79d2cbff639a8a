// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Boxes and k-DOPs on one core: every instruction set by size, layout, bad points and scene, beside other
// people's code and the speed at which the same bytes can be read. Rows are named
// WORK/ISA/SCENE/LAYOUT/BAD/n:POINTS. Answers are checked, then timed; no time passes or fails.

#include <benchmark/benchmark.h>

#include "reading.h"
#include "rows.h"

namespace pcl_bv::bench {
namespace {

const std::vector<std::string> kBoth = {"aabb", "dop26"};

void add_fit(const std::string& work, Isa isa, const CloudName& name) {
  const Fit fit(work);
  add(work, std::string(isa_name(isa)), name, [=](benchmark::State& state) {
    Cloud& points = cloud(name);
    const Execution execution{Serial{}, isa};
    fit.check(points, execution);
    time_passes(state, points, [&] { fit(points, execution); });
  });
}

void add_fits(const std::vector<std::string>& works, const CloudName& name) {
  for (const std::string& work : works) {
    for (const Isa isa : usable_isas())
      add_fit(work, isa, name);
  }
}

void add_peers(const std::vector<std::string>& names, const CloudName& cloud) {
  for (const std::string& name : names)
    add_peer(peer(name), cloud);
}

void add_reading(const CloudName& name) {
  for (const unsigned threads : {1U, 2U}) {
    if (threads == 2 && name.points == kL1) continue;  // less than it takes to wake a thread
    add("read-" + std::to_string(threads) + "-thread", "best", name, [=](benchmark::State& state) {
      const Cloud& points = cloud(name);
      const Reading reading(points, threads);
      time_passes(state, points, reading);
      state.SetLabel(reading.text());
    })->UseRealTime();
  }
}

void add_unchecked(const CloudName& name) {
  for (const Unchecked& kernel : unchecked()) {
    for (const Isa isa : usable_isas()) {
      if (isa == Isa::scalar) continue;  // that is plain-dop26
      add("unchecked-" + kernel.work, std::string(isa_name(isa)), name, [=](benchmark::State& state) {
        const Cloud& points = cloud(name);
        kernel.check(isa, points);
        time_passes(state, points, [&] { benchmark::DoNotOptimize(kernel.run(isa, points.view)); });
      });
    }
  }
}

void tables_of_the_paper() {
  for (const std::size_t points : kPaperSizes) {
    const CloudName cloud{"paper", points};
    add_fits({"aabb", "dop14", "dop26"}, cloud);
    if (points == 100'722) add_fits({"dop18"}, cloud);
    add_peers({"pcl-dense", "pcl-non-dense", "naive-dop26", "plain-dop26"}, cloud);
  }
}

void levels_of_memory() {
  for (const std::size_t points : {kL1, kL2, kL3, kMemory}) {
    const CloudName cloud{"gauss", points};
    add_fits(kBoth, cloud);
    if (points == kL2 || points == kMemory) add_fits({"dop14", "dop18", "dop26-points"}, cloud);
    add_unchecked(cloud);
    add_reading(cloud);
    for (const Peer& peer : peers())
      add_peer(peer, {"gauss", points, peer.layout});
  }
}

void layouts_in_memory() {
  for (const std::string& layout : layouts()) {
    if (layout == "xyz") continue;  // above
    add_fits(kBoth, {"gauss", kL2, layout});
    for (const std::string& work : kBoth)
      add_fit(work, usable_isas().back(), {"gauss", kMemory, layout});
  }
}

void bad_points() {
  for (const std::size_t points : {kL2, kMemory}) {
    for (const std::string bad : {"one-nan", "1pc-nan"}) {
      const CloudName cloud{"gauss", points, "xyz", bad};
      add_fits(kBoth, cloud);
      add_peers({"pcl-dense", "pcl-non-dense"}, cloud);
    }
  }
}

void scenes() {
  for (const std::string scene : {"gauss", "cube", "street"})
    add_fits(kBoth, {scene, 128'000});
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  pcl_bv::bench::tables_of_the_paper();
  pcl_bv::bench::levels_of_memory();
  pcl_bv::bench::layouts_in_memory();
  pcl_bv::bench::bad_points();
  pcl_bv::bench::scenes();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
