// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Boxes and k-DOPs on one core: every instruction set by size, layout, bad points and scene, beside other
// people's code and the speed at which the same bytes can be read. Rows are named
// WORK/ISA/SCENE/LAYOUT/BAD/n:POINTS. Answers are checked, then timed; no time passes or fails.

#include "cgal.h"
#include "rows.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

const std::vector<std::string> kBoth = {"aabb", "dop26"};

void add_peers(const std::vector<std::string>& names, const CloudName& cloud) {
  for (const std::string& name : names)
    add_peer(peer(name), cloud);
}

void add_unchecked(const CloudName& name) {
  for (const Unchecked& kernel : unchecked()) {
    for (const Isa isa : simd_isas()) {
      add(kernel.name, std::string(isa_name(isa)), name, [=](benchmark::State& state) {
        const Cloud& points = cloud(name);
        kernel.check(isa, points);
        time_passes(state, [&] { benchmark::DoNotOptimize(kernel.run(isa, points.view)); });
      });
    }
  }
}

void levels_of_memory() {
  for (const std::size_t points : {kL1, kL2, kL3, kMemory}) {
    const CloudName cloud{"gauss", points};
    add_fits(kBoth, usable_isas(), cloud);
    if (points == kL2 || points == kMemory)
      add_fits({"dop14", "dop18", "dop26-points"}, usable_isas(), cloud);
    add_unchecked(cloud);
    add_reading(cloud, 1);
    if (points != kL1) add_reading(cloud, 2);  // less than it takes to wake a thread
    for (const Peer& peer : peers())
      add_peer(peer, {"gauss", points, peer.layout});
    for (const Peer& peer : cgal_boxes())
      add_peer(peer, cloud);
  }
}

void layouts_in_memory() {
  for (const std::string& layout : layouts()) {
    if (layout == "xyz") continue;  // above
    add_fits(kBoth, usable_isas(), {"gauss", kL2, layout});
    for (const std::string& work : kBoth)
      add_fit(work, usable_isas().back(), {"gauss", kMemory, layout});
  }
}

void bad_points() {
  for (const std::size_t points : {kL2, kMemory}) {
    for (const std::string bad : {"one-nan", "1pc-nan"}) {
      const CloudName cloud{"gauss", points, "xyz", bad};
      add_fits(kBoth, usable_isas(), cloud);
      add_peers({"pcl-dense", "pcl-non-dense"}, cloud);
    }
  }
}

void scenes() {
  for (const std::string scene : {"gauss", "cube", "street"})
    add_fits(kBoth, usable_isas(), {scene, 128'000});
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  pcl_bv::bench::levels_of_memory();
  pcl_bv::bench::layouts_in_memory();
  pcl_bv::bench::bad_points();
  pcl_bv::bench::scenes();
  return pcl_bv::bench::run_program(argc, argv);
}
