// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Oriented boxes: each method on each cloud, with its volume over that of the smallest
// box known
// (`over_least`); in turns, ours against CGAL's, PCL's and what a 14-DOP costs; and clusters of 300 points by
// the hundred. Results are checked, then timed.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <vector>

#include "obb_clouds.h"
#include "obb_peers.h"
#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/fitting/supports.h"
#include "timing.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

constexpr int kTurns = 9, kTurnsOfTheSlow = 3;  // 0.3 s each on 100 k points

void fit(benchmark::State& state, const std::string& name, const Method* method, Isa isa) {
  const ObbCloud& cloud = obb_cloud(name);
  AnyVolume volume = *method->fit(cloud.view(), {}, {Serial{}, isa});
  require_enclosed(volume, cloud.view());
  for (auto _ : state) {
    volume = *method->fit(cloud.view(), {}, {Serial{}, isa});
    benchmark::DoNotOptimize(volume);
  }
  state.counters["over_least"] = std::get<Obb>(volume).volume() / least_volume(cloud);
}

void against_peer(benchmark::State& state, const std::string& name, const ObbPeer* peer,
                  const Method* method) {
  const ObbCloud& cloud = obb_cloud(name);
  AnyVolume volume = *method->fit(cloud.view());
  require_enclosed(volume, cloud.view());
  const PeerBox theirs = peer->run(cloud);
  compare(
      state, [&] { benchmark::DoNotOptimize(peer->run(cloud)); },
      [&] { volume = *method->fit(cloud.view()); });
  state.counters["volume_over_peer"] = std::get<Obb>(volume).volume() / theirs.volume();
  state.counters["outside"] = static_cast<double>(theirs.points_outside(cloud));
}

// What DiTO-14 is made of: the 14-DOP with its points, and the extents along three directions.
void dito_against_its_passes(benchmark::State& state, const std::string& name) {
  const ObbCloud& cloud = obb_cloud(name);
  const std::vector<std::array<double, 3>> directions{{0.8, 0.6, 0}, {-0.6, 0.8, 0}, {0, 0, 1}};
  AnyVolume volume;
  compare(
      state, [&] { volume = *find_method("obb-dito14")->fit(cloud.view()); },
      [&] {
        detail::Supports supports =
            detail::find_supports(cloud.view(), DirectionSet::dop14, detail::SupportDetail::points, {});
        benchmark::DoNotOptimize(supports);
        detail::CustomSupports along = detail::find_supports(cloud.view(), directions);
        benchmark::DoNotOptimize(along);
      });
}

// Both need the outline seen from above. The box also measures its axes on all points.
void prism_against_yaw(benchmark::State& state, const std::string& name, const Eigen::Vector3d& up) {
  const ObbCloud& cloud = obb_cloud(name);
  MethodOptions options;
  options.up = up;
  AnyVolume volume;
  compare(
      state, [&] { volume = *find_method("prism")->fit(cloud.view(), options); },
      [&] { volume = *find_method("obb-yaw")->fit(cloud.view(), options); });
}

constexpr std::size_t kClusters = 100, kClusterPoints = 300;

std::vector<PointView> clusters() {
  static const ObbCloud cloud = make_clusters(kClusters, kClusterPoints);
  std::vector<PointView> views;
  for (std::size_t i = 0; i < kClusters; ++i)
    views.push_back(cloud.view().slice(i * kClusterPoints, kClusterPoints));
  return views;
}

void fit_clusters(const std::vector<PointView>& views, const std::vector<const Method*>& methods,
                  const Execution& execution) {
  for_each_view(
      views,
      [&](std::size_t i, const Execution& inner) {
        detail::Supports supports;
        const detail::FitExecution shared = detail::share_supports(views[i], methods, inner, supports);
        for (const Method* method : methods) {
          AnyVolume volume;
          detail::fit_method(*method, views[i], {}, volume, shared);
          benchmark::DoNotOptimize(volume);
        }
      },
      execution);
}

std::vector<const Method*> named(const std::vector<std::string>& names) {
  std::vector<const Method*> result;
  for (const std::string& name : names)
    result.push_back(find_method(name));
  return result;
}

void many_clusters(benchmark::State& state, const std::vector<std::string>& names, unsigned threads) {
  const std::vector<PointView> views = clusters();
  const std::vector<const Method*> methods = named(names);
  for (auto _ : state)
    fit_clusters(views, methods, {policy_of(threads), Isa::automatic});
}

void clusters_against_pcl(benchmark::State& state, const ObbPeer* peer) {
  const std::vector<PointView> views = clusters();
  std::vector<ObbCloud> theirs;
  for (const PointView& view : views)
    theirs.emplace_back(view);
  const std::vector<const Method*> methods = named({"aabb", "obb-pca"});
  compare(
      state,
      [&] {
        for (const ObbCloud& cloud : theirs)
          benchmark::DoNotOptimize(peer->run(cloud));
      },
      [&] { fit_clusters(views, methods, {}); });
}

template <typename... Arguments>
auto* add(const std::string& name, Arguments... arguments) {
  return benchmark::RegisterBenchmark(name.c_str(), arguments...)->Unit(benchmark::kMicrosecond);
}

void turns(const std::string& name, auto body, auto... arguments) {
  const bool slow = name.starts_with("PCL MomentOfInertia over");
  add_turns("turns/" + name, slow ? kTurnsOfTheSlow : kTurns,
            [=](benchmark::State& state) { body(state, arguments...); });
}

void add_all() {
  for (const std::string& cloud : obb_cloud_names()) {
    for (const Method& method : methods()) {
      if (method.shape != "obb") continue;
      const Isa best = usable_isas().back();
      add(std::string(method.name) + '/' + std::string(isa_name(best)) + '/' + cloud, fit, cloud, &method,
          best);
    }
    for (const ObbPeer& peer : obb_peers())
      turns(peer.name + " over " + peer.against + '/' + cloud, against_peer, cloud, &peer,
            find_method(peer.against));
    turns("obb-dito14 over its two passes/" + cloud, dito_against_its_passes, cloud);
    turns("prism over obb-yaw/" + cloud, prism_against_yaw, cloud, Eigen::Vector3d(0, 0, 1));
    turns("prism over obb-yaw, tilted/" + cloud, prism_against_yaw, cloud, Eigen::Vector3d(0.1, 0.2, 1));
  }
  for (const ObbPeer& peer : obb_peers()) {
    if (peer.against == "obb-pca") {
      turns("100 clusters of 300, " + peer.name + " over aabb + obb-pca", clusters_against_pcl, &peer);
    }
  }
  for (const unsigned threads : {1U, 2U}) {
    add("100 clusters of 300/aabb + sphere-exact + obb-dito14/threads:" + std::to_string(threads) +
            wait_policy(),
        many_clusters, std::vector<std::string>{"aabb", "sphere-exact", "obb-dito14"}, threads)
        ->UseRealTime()
        ->ComputeStatistics("min", [](const std::vector<double>& all) { return std::ranges::min(all); });
  }
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  pcl_bv::bench::add_all();
  return pcl_bv::bench::run_program(argc, argv);
}
