// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Comparisons that must hold on a machine that is not quiet: both sides in turns, 30 times, and the counter
// `ratio` says how many times faster the second one was (timing.h). Rows are named
// COMPARISON/WORK/ISA/SCENE/LAYOUT/BAD/n:POINTS, and /wait:POLICY where threads wait for work as
// OMP_WAIT_POLICY says.

#include "cgal.h"
#include "rows.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

void over_scalar() {
  const Fit dop26("dop26");
  const CloudName name{"gauss", kL2};
  for (const Isa isa : simd_isas()) {
    add_comparison("over-scalar", dop26, {Serial{}, isa}, name, "", [=](const Cloud& points) {
      return [&points, dop26] { dop26(points, {Serial{}, Isa::scalar}); };
    });
    for (const std::string plain : {"plain-dop26", "naive-dop26"}) {
      add_comparison("over-" + plain, dop26, {Serial{}, isa}, name, "",
                     [=](const Cloud& points) { return [&points, run = peer(plain).run] { run(points); }; });
    }
  }
}

void spheres_over_scalar() {
  const Fit epos26("sphere-epos26");
  for (const CloudName& name : {CloudName{"gauss", kL2}, CloudName{"paper", 100'722}}) {
    for (const Isa isa : simd_isas()) {
      add_comparison("over-scalar", epos26, {Serial{}, isa}, name, "", [=](const Cloud& points) {
        return [&points, epos26] { epos26(points, {Serial{}, Isa::scalar}); };
      });
    }
  }
}

// The smallest sphere beside one that is nearly so, and beside another solver.
void smallest_sphere() {
  const Fit exact("sphere-exact"), epos26("sphere-epos26");
  const Isa best = usable_isas().back();
  for (const std::string scene : {"gauss", "cube", "ball", "car", "golfball", "surface"}) {
    for (const std::size_t points : {100'722, 1'000'000}) {
      const CloudName name{scene, points};
      add_comparison("over-epos26", exact, {Serial{}, best}, name, "", [=](const Cloud& cloud) {
        return [&cloud, best, epos26] { epos26(cloud, {Serial{}, best}); };
      });
      if (points < 1'000'000) continue;
      for (const Peer& peer : cgal_spheres()) {
        add_comparison("over-" + peer.name, exact, {Serial{}, best}, name, "",
                       [run = peer.run](const Cloud& cloud) { return [&cloud, run] { run(cloud); }; });
      }
    }
  }
}

void of_bandwidth(const std::string& work, Isa isa, unsigned threads) {
  const ParallelPolicy policy = policy_of(threads);
  const std::string suffix = "/threads:" + std::to_string(threads) + (threads == 1 ? "" : wait_policy());
  add_comparison("of-bandwidth", Fit(work), {policy, isa}, {"gauss", kMemory}, suffix,
                 [=](const Cloud& points) { return Reading(points, threads); });
}

void of_bandwidth() {
  for (const Isa isa : simd_isas()) {
    for (const unsigned threads : {1U, 2U})
      of_bandwidth("dop26", isa, threads);
  }
  of_bandwidth("aabb", usable_isas().back(), 1);
}

void over_pcl(std::size_t points) {
  for (const std::string flag : {"pcl-dense", "pcl-non-dense"}) {
    for (const Isa isa : simd_isas()) {
      add_comparison("over-" + flag, Fit("aabb"), {Serial{}, isa}, {"gauss", points}, "",
                     [run = peer(flag).run](const Cloud& cloud) { return [&cloud, run] { run(cloud); }; });
    }
  }
}

// What the test of every point and the exact look cost: less than 1 is slower than a kernel without them.
void over_unchecked(std::size_t points) {
  const CloudName name{"gauss", points};
  for (const Unchecked& kernel : unchecked()) {
    for (const Isa isa : simd_isas()) {
      add_comparison("over-" + kernel.name, Fit(kernel.work), {Serial{}, isa}, name, "",
                     [isa, kernel](const Cloud& cloud) {
                       kernel.check(isa, cloud);
                       return
                           [&cloud, isa, kernel] { benchmark::DoNotOptimize(kernel.run(isa, cloud.view)); };
                     });
    }
  }
}

// The test alone.
void tested_over_unchecked(std::size_t points) {
  const CloudName name{"gauss", points};
  for (const Isa isa : simd_isas()) {
    add_turns("over-unchecked-dop26/tested-dop26/" + std::string(isa_name(isa)) + '/' + name.text(), kPairs,
              [=](benchmark::State& state) {
                const Cloud& made = cloud(name);
                compare(
                    state, [&] { benchmark::DoNotOptimize(unchecked_dop26(isa, made.view)); },
                    [&] { benchmark::DoNotOptimize(tested_dop26(isa, made.view)); });
              });
  }
}

void two_threads_over_one() {
  const Isa best = usable_isas().back();
  for (std::size_t points = 4096 << 13; points >= 4096;
       points /= 2) {  // the small ones are parts of the first
    add_threads(2, "aabb", best, {"gauss", points});
    for (const Isa isa : simd_isas())
      add_threads(2, "dop26", isa, {"gauss", points});
  }
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  if (pcl_bv::usable_isas().size() > 1) {
    pcl_bv::bench::over_scalar();
    pcl_bv::bench::spheres_over_scalar();
    pcl_bv::bench::smallest_sphere();
    for (const std::size_t points : {pcl_bv::bench::kL2, pcl_bv::bench::kMemory}) {
      pcl_bv::bench::over_pcl(points);
      pcl_bv::bench::over_unchecked(points);
      pcl_bv::bench::tested_over_unchecked(points);
    }
    pcl_bv::bench::of_bandwidth();
    pcl_bv::bench::two_threads_over_one();
  }
  return pcl_bv::bench::run_program(argc, argv);
}
