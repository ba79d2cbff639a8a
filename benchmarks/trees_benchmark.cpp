// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Trees over points. Rows, all on one thread unless they say otherwise:
//   tree/build/ISA/SCENE/n:POINTS/threads:N                 ours alone
//   tree/sphere/ISA/SCENE/n:POINTS/r:PART/threads:1         a yes-or-no question of ours, PART of the side
//   tree/over-PEER/WHAT/ISA/SCENE/n:POINTS/threads:1        in turns; WHAT is build or a question or, of a
//                                                           sweep with the build, sweep-nearest, sweep-radius
//   tree/over-embree/ray/ISA/SCENE/n:POINTS/threads:1
//   volumes/over-loop/WHAT/n:VOLUMES/threads:1, volumes/links/ISA/SCENE/n:POINTS/threads:1 tree_volumes.cpp
//   tree/wrong/ISA/questions:N                              ours against all points (tree_truth.cpp)
// `wrong` counts a peer's answers that rounding to float does not explain, of `questions`.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "pcl_bv/estimation/fit_cloud.h"
#include "pcl_bv/trees/point_tree.h"
#include "timing.h"
#include "tree_rows.h"
#include "tree_truth.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

void add_build(Isa isa, const std::string& scene, std::size_t points, unsigned threads) {
  const std::string row = "tree/build/" + tree_input_name(isa, scene, points) +
                          "/threads:" + std::to_string(threads) + (threads == 1 ? "" : wait_policy());
  auto* const registered = benchmark::RegisterBenchmark(row.c_str(), [=](benchmark::State& state) {
    const TreeInput& input = tree_input(scene, points);
    const PointView view = point_view(*input.cloud);
    PointTree tree;
    tree.assign(view, {policy_of(threads), isa});
    for (auto _ : state)
      tree.assign(view, {policy_of(threads), isa});
    state.counters["points"] = static_cast<double>(view.count);
  });
  registered->Unit(benchmark::kMicrosecond);
  if (threads > 1) registered->UseRealTime();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

double nanoseconds_of(const auto& run) {
  const auto begin = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
}

// The mean of the lesser half: steps of the clock (10 ns on some machines) even out, interruptions do not
// count.
double usual(std::vector<double> values) {
  const auto half = values.begin() + (values.size() + 1) / 2;
  std::nth_element(values.begin(), half - 1, values.end());
  return std::accumulate(values.begin(), half, 0.0) / static_cast<double>(half - values.begin());
}

// Nanoseconds of each question, timed alone and in its turn, twenty times, less what reading the clock takes;
// of that the median: what a caller waits for who asks once in a while.
double median_alone(const PointTree& tree, const std::vector<Sphere>& spheres) {
  std::vector<double> times;
  std::vector<std::vector<double>> alone(spheres.size()), clock(spheres.size());
  for (int round = 0; round < (tiny() ? 1 : 20); ++round) {
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      bool answer = false;
      alone[i].push_back(
          nanoseconds_of([&] { benchmark::DoNotOptimize(answer = tree.any_inside(spheres[i])); }));
      clock[i].push_back(nanoseconds_of([&] { benchmark::DoNotOptimize(answer); }));
    }
  }
  for (std::size_t i = 0; i < spheres.size(); ++i)
    times.push_back(usual(alone[i]) - usual(clock[i]));
  return median(times);
}

// `mean_ns`: all centres one after another. `median_ns`: median_alone().
void add_sphere(Isa isa, const std::string& scene, std::size_t points, const char* part) {
  const std::string row = "tree/sphere/" + tree_input_name(isa, scene, points) + "/r:" + part + "/threads:1";
  add_turns(row, kPairs, [=](benchmark::State& state) {
    const TreeInput& input = tree_input(scene, points);
    const PointTree tree(point_view(*input.cloud), {Serial{}, isa});
    std::vector<Sphere> spheres;
    for (const pcl::PointXYZ& p : input.centres)
      spheres.push_back(Sphere({p.x, p.y, p.z}, std::atof(part) * input.side));
    std::size_t inside = 0;
    const auto ask_all = [&] {
      inside = 0;
      for (const Sphere& sphere : spheres)
        inside += tree.any_inside(sphere);
    };
    std::vector<double> means;
    for (auto _ : state) {
      const double time = seconds(ask_all, 1);
      means.push_back(1e9 * time / static_cast<double>(spheres.size()));
      state.SetIterationTime(time);
    }
    state.counters["mean_ns"] = median(means);
    state.counters["median_ns"] = median_alone(tree, spheres);
    state.counters["inside"] = static_cast<double>(inside);
    state.counters["questions"] = static_cast<double>(spheres.size());
  });
}

void ask(Tree& tree, Question question, const std::vector<pcl::PointXYZ>& places, float radius) {
  double sum = 0;
  for (const pcl::PointXYZ& place : places)
    sum += tree.answer(question, place, radius);
  benchmark::DoNotOptimize(sum);
}

std::size_t count_wrong(Tree& theirs, Tree& ours, Question question, const std::vector<pcl::PointXYZ>& places,
                        float radius) {
  std::size_t wrong = 0;
  for (const pcl::PointXYZ& place : places) {
    const double answer = theirs.answer(question, place, radius);
    if (question == Question::nearest || question == Question::nearest_10) {
      const double truth = ours.answer(question, place, radius);
      wrong += !(std::abs(answer - truth) <= 1e-6 * truth);
    } else {
      wrong += answer < ours.answer(question, place, radius * (1 - 1e-6F)) ||
               answer > ours.answer(question, place, radius * (1 + 1e-6F));
    }
  }
  return wrong;
}

void add_builds(const TreePeer& peer, Isa isa, const std::string& scene, std::size_t points, int pairs) {
  add_turns(over(peer.name, "build", isa, scene, points), pairs, [=](benchmark::State& state) {
    const TreeInput& input = tree_input(scene, points);
    const TreePeer ours = our_tree({Serial{}, isa});
    compare(
        state, [&] { peer.build(input.cloud, input.radius); },
        [&] { ours.build(input.cloud, input.radius); });
    state.counters["points"] = static_cast<double>(input.cloud->size());
  });
}

void add_questions(const TreePeer& peer, Question question, Isa isa, const std::string& scene,
                   std::size_t points) {
  add_turns(over(peer.name, name_of(question), isa, scene, points), kPairs, [=](benchmark::State& state) {
    const TreeInput& input = tree_input(scene, points);
    const auto places = places_of(input, question);
    const TreePeer by_us = our_tree({Serial{}, isa});
    const auto theirs = peer.build(input.cloud, input.radius), ours = by_us.build(input.cloud, input.radius);
    compare(
        state, [&] { ask(*theirs, question, places, input.radius); },
        [&] { ask(*ours, question, places, input.radius); });
    state.counters["wrong"] =
        static_cast<double>(count_wrong(*theirs, *ours, question, places, input.radius));
    state.counters["questions"] = static_cast<double>(places.size());
  });
}

// What a stream does with a tree: built over one sweep, and asked for each point of the next.
void add_sweep(const TreePeer& peer, Question question, Isa isa, const std::string& scene,
               std::size_t points) {
  add_turns(over(peer.name, "sweep-" + name_of(question), isa, scene, points), 9,
            [=](benchmark::State& state) {
              const TreeInput& input = tree_input(scene, points);
              const auto run = [&](const TreePeer& one) {
                ask(*one.build(input.cloud, input.radius), question, input.near, input.radius);
              };
              const TreePeer ours = our_tree({Serial{}, isa});
              compare(
                  state, [&] { run(peer); }, [&] { run(ours); });
              state.counters["points"] = static_cast<double>(input.cloud->size());
              state.counters["questions"] = static_cast<double>(input.near.size());
            });
}

void add_wrong(Isa isa) {
  add_turns("tree/wrong/" + std::string(isa_name(isa)) + "/questions:1000000", 1,
            [=](benchmark::State& state) {
              for (auto _ : state) {
                TreeTruth truth;
                state.SetIterationTime(
                    seconds([&] { truth = count_wrong_answers(isa, tiny() ? 7000 : 1'000'000); }, 1));
                state.counters["wrong"] = static_cast<double>(truth.wrong);
                state.counters["questions"] = static_cast<double>(truth.questions);
              }
            });
}

void over_peers(Isa isa, const std::string& scene, std::size_t points) {
  for (const TreePeer& peer : tree_peers()) {
    if (points > 1'000'000 && peer.name != "flann" && peer.name != "nanoflann")
      continue;  // minutes, gigabytes
    if (points > 200'000 && peer.name.starts_with("fcl")) continue;
    add_builds(peer, isa, scene, points, points > 200'000 ? 3 : peer.name == "flann" ? kPairs : 9);
    for (const Question question : peer.questions) {
      if (points <= 1'000'000 || question == Question::nearest || question == Question::any)
        add_questions(peer, question, isa, scene, points);
    }
  }
}

void over_kd_trees(Isa isa, const std::string& scene, std::size_t points) {
  for (const TreePeer& peer : tree_peers()) {
    if (peer.name != "flann" && peer.name != "nanoflann") continue;
    for (const Question question : {Question::nearest, Question::radius})
      add_sweep(peer, question, isa, scene, points);
  }
}

void register_all() {
  const std::vector<Isa> sets = usable_isas();
  const Isa best = sets.back();
  const char* const parts[] = {"0.001", "0.003", "0.01", "0.03", "0.1"};
  for (const Isa isa : sets) {
    add_build(isa, "gauss", 100'000, 1);
    for (const char* part : parts)
      add_sphere(isa, "gauss", 100'000, part);
    add_wrong(isa);
  }
  for (const std::string scene : {"cube", "ball", "car", "golfball", "surface", "street"}) {
    const std::size_t points = scene == "street" ? 128'000 : 100'000;
    add_build(best, scene, points, 1);
    for (const char* part : parts)
      add_sphere(best, scene, points, part);
  }
  add_volumes(best);
  over_peers(best, "street", 128'000);
  over_kd_trees(best, "street", 128'000);
  add_build(best, "street", 128'000, 2);
  if (std::getenv("PCL_BV_DATA") != nullptr && !tiny()) {
    add_build(best, "sweep", 0, 1);
    over_kd_trees(best, "sweep", 0);
  }
  for (std::size_t points = 1000; points <= 10'000'000; points *= 10) {
    if (points != 100'000) add_build(best, "gauss", points, 1);
    if (points >= 100'000) add_build(best, "gauss", points, 2);
    over_peers(best, "gauss", points);
#ifdef PCL_BV_BENCH_EMBREE
    if (points <= 1'000'000) add_rays(best, "gauss", points);
#endif
  }
#ifdef PCL_BV_BENCH_EMBREE
  add_rays(best, "street", 128'000);
#endif
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  pcl_bv::bench::register_all();
  return pcl_bv::bench::run_program(argc, argv);
}
