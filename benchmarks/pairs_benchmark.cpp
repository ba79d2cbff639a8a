// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Comparisons that must hold on a machine that is not quiet: both sides in turns, 30 times, and the counter
// `ratio` says how many times faster the second one was (timing.h). Rows are named
// COMPARISON/WORK/ISA/SCENE/LAYOUT/BAD/n:POINTS, and /wait:POLICY where threads wait for work as
// OMP_WAIT_POLICY says.

#include <benchmark/benchmark.h>

#include <cstdlib>

#include "cgal.h"
#include "clouds.h"
#include "fits.h"
#include "peers.h"
#include "reading.h"
#include "timing.h"

namespace pcl_bv::bench {
namespace {

std::vector<Isa> simd_isas() {
  std::vector<Isa> sets = usable_isas();
  sets.erase(sets.begin());  // scalar
  return sets;
}

std::string wait_policy() {
  const char* policy = std::getenv("OMP_WAIT_POLICY");
  return std::string("/wait:") + (policy ? policy : "default");
}

// Compares what make_first(cloud) returns with a fit on `execution`.
template <typename MakeFirst>
void add(const std::string& comparison, const Fit& fit, const Execution& execution, const CloudName& name,
         const std::string& suffix, MakeFirst make_first) {
  const std::string row =
      comparison + '/' + fit.name() + '/' + std::string(isa_name(execution.isa)) + '/' + name.text() + suffix;
  benchmark::RegisterBenchmark(row.c_str(),
                               [=](benchmark::State& state) {
                                 Cloud& points = cloud(name);
                                 fit.check(points, execution);
                                 compare(state, make_first(points), [&] { fit(points, execution); });
                               })
      ->Iterations(kPairs)
      ->Repetitions(1)
      ->UseManualTime()
      ->Unit(benchmark::kMicrosecond);
}

void over_scalar() {
  const Fit dop26("dop26");
  for (const CloudName& name : {CloudName{"gauss", kL2}, CloudName{"paper", 100'722}}) {
    for (const Isa isa : simd_isas()) {
      add("over-scalar", dop26, {Serial{}, isa}, name, "", [=](const Cloud& points) {
        return [&points, dop26] { dop26(points, {Serial{}, Isa::scalar}); };
      });
      for (const std::string plain : {"plain-dop26", "naive-dop26"}) {
        add("over-" + plain, dop26, {Serial{}, isa}, name, "",
            [=](const Cloud& points) { return [&points, run = peer(plain).run] { run(points); }; });
      }
    }
  }
}

void spheres_over_scalar() {
  const Fit epos26("sphere-epos26");
  for (const CloudName& name : {CloudName{"gauss", kL2}, CloudName{"paper", 100'722}}) {
    for (const Isa isa : simd_isas()) {
      add("over-scalar", epos26, {Serial{}, isa}, name, "", [=](const Cloud& points) {
        return [&points, epos26] { epos26(points, {Serial{}, Isa::scalar}); };
      });
    }
  }
}

// The smallest sphere beside one that is nearly so, and beside another solver.
void smallest_sphere() {
  const Fit exact("sphere-exact");
  for (const std::string scene : {"gauss", "cube", "ball", "car", "golfball", "surface"}) {
    for (const std::size_t points : {100'722, 1'000'000}) {
      const CloudName name{scene, points};
      for (const Isa isa : simd_isas()) {
        add("over-epos26", exact, {Serial{}, isa}, name, "",
            [isa, epos26 = Fit("sphere-epos26")](const Cloud& cloud) {
              return [&cloud, isa, epos26] { epos26(cloud, {Serial{}, isa}); };
            });
      }
      if (points < 1'000'000 || cgal_min_sphere() == nullptr) continue;
      add("over-cgal", exact, {Serial{}, usable_isas().back()}, name, "",
          [run = cgal_min_sphere()->run](const Cloud& cloud) { return [&cloud, run] { run(cloud); }; });
    }
  }
}

void of_bandwidth() {
  for (const std::string work : {"dop26", "aabb"}) {
    for (const Isa isa : simd_isas()) {
      for (const unsigned threads : {1U, 2U}) {
        const Execution execution{threads == 1 ? ParallelPolicy(Serial{}) : ParallelPolicy(OpenMP{threads}),
                                  isa};
        const std::string suffix =
            "/threads:" + std::to_string(threads) + (threads == 1 ? "" : wait_policy());
        add("of-bandwidth", Fit(work), execution, {"gauss", kMemory}, suffix,
            [=](const Cloud& points) { return Reading(points, threads); });
      }
    }
  }
}

void over_pcl(std::size_t points) {
  for (const std::string flag : {"pcl-dense", "pcl-non-dense"}) {
    for (const Isa isa : simd_isas()) {
      add("over-" + flag, Fit("aabb"), {Serial{}, isa}, {"gauss", points}, "",
          [run = peer(flag).run](const Cloud& cloud) { return [&cloud, run] { run(cloud); }; });
    }
  }
}

// What the test of every point and the exact look cost: less than 1 is slower than a kernel without both.
void over_unchecked(std::size_t points) {
  for (const Unchecked& kernel : unchecked()) {
    for (const Isa isa : simd_isas()) {
      add("over-unchecked", Fit(kernel.work), {Serial{}, isa}, {"gauss", points}, "",
          [isa, kernel](const Cloud& cloud) {
            kernel.check(isa, cloud);
            return [&cloud, isa, kernel] { benchmark::DoNotOptimize(kernel.run(isa, cloud.view)); };
          });
    }
  }
}

void two_threads(const std::string& work, Isa isa, const CloudName& name) {
  const Fit fit(work);
  add("two-threads", fit, {OpenMP{2}, isa}, name, wait_policy(), [=](const Cloud& points) {
    return [&points, fit, isa] { fit(points, {Serial{}, isa}); };
  });
}

void two_threads_over_one() {
  const Isa best = usable_isas().back();
  for (const std::size_t points : kPaperSizes) {
    two_threads("dop26", simd_isas().front(), {"paper", points});  // the paper's SSE
    two_threads("dop26", best, {"paper", points});
  }
  for (std::size_t points = 4096 << 13; points >= 4096;
       points /= 2) {  // the small ones are parts of the first
    two_threads("aabb", best, {"gauss", points});
    for (const Isa isa : simd_isas())
      two_threads("dop26", isa, {"gauss", points});
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
    }
    pcl_bv::bench::of_bandwidth();
    pcl_bv::bench::two_threads_over_one();
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
