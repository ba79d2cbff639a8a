// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits on a graphics card, beside the same fits on the processor. PCL_BV_GPU names the device (the first
// one). Rows are gpu/WORK/n:POINTS, for clouds on the device, gpu/upload-and-dop26/n:POINTS, for clouds in
// the processor's memory, and gpu/processor-WORK/n:POINTS for two threads. GB/s are 12
// bytes for each point of a call; a fit that reads points twice has twice the traffic. gpu/copy counts bytes
// read and written by the driver's copies, which can be slower than its shaders. Each row of a fit compares
// its volume with that of the processor. Larger clouds are left out on software drivers.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <random>

#include "device_points.h"
#include "pcl_bv/gpu/gpu_fit.h"
#include "pcl_bv/gpu/gpu_tree.h"
#include "pcl_bv/parallel/execution.h"
#include "program.h"

namespace pcl_bv::bench {
namespace {

using Floats = std::vector<float>;

// A sweep of a room of 20 m: few blocks have extreme points, as in measured clouds.
Floats make_cloud(std::size_t points) {
  std::mt19937 random(1);
  Floats xyz(3 * points);
  for (std::size_t i = 0; i < points; ++i) {
    const float angle = 6.2831853F * static_cast<float>(i) / static_cast<float>(points);
    const auto noise = [&] { return static_cast<float>(random()) * 0x1p-32F; };
    xyz[3 * i] = (8 + 2 * noise()) * std::cos(angle);
    xyz[3 * i + 1] = (8 + 2 * noise()) * std::sin(angle);
    xyz[3 * i + 2] = 3 * noise();
  }
  return xyz;
}

// Keeps the last cloud: each row asks for it several times, and 10^8 points take 4 s to make.
const Floats& cloud_of(std::size_t points) {
  static Floats last;
  if (last.size() != 3 * points) last = make_cloud(points);
  return last;
}

PointView view_of(const Floats& xyz) {
  return PointView::of(xyz.data(), 12, xyz.size() / 3);
}

std::vector<const Method*> methods_named(const std::vector<std::string>& names) {
  std::vector<const Method*> methods;
  for (const std::string& name : names)
    methods.push_back(find_method(name));
  return methods;
}

std::vector<std::size_t> offsets_of(std::size_t points, std::size_t in_cluster) {
  std::vector<std::size_t> offsets;
  for (std::size_t begin = 0; begin <= points; begin += in_cluster)
    offsets.push_back(begin);
  return offsets;
}

constexpr std::chrono::milliseconds kWarmUp(300);  // in which a card that idled raises its clock

void add(const std::string& name, std::size_t points,
         const std::function<void(benchmark::State&, std::size_t)>& run) {
  benchmark::RegisterBenchmark(("gpu/" + name + "/n:" + std::to_string(points)).c_str(),
                               [=](benchmark::State& state) {
                                 const std::size_t n = points_in_this_run(points);
                                 run(state, n);
                                 state.counters["points"] = static_cast<double>(n);
                               })
      ->UseRealTime()
      ->Unit(benchmark::kMicrosecond);
}

// Repeats `work`, and sets how many points it takes in a second and, for points on the device, their bytes.
template <typename Work>
void measure(benchmark::State& state, std::size_t points, bool on_device, const Work& work) {
  const auto now = [] { return std::chrono::steady_clock::now(); };
  for (const auto end = now() + kWarmUp; now() < end;)
    work();
  const auto begin = now();
  for (auto _ : state)
    work();
  const double seconds = std::chrono::duration<double>(now() - begin).count();
  const double rate = static_cast<double>(points) * static_cast<double>(state.iterations()) / seconds;
  state.counters["Mpt/s"] = rate * 1e-6;
  if (on_device) state.counters["GB/s"] = 12e-9 * rate;
}

void add_copy(const GpuDevice& device) {
  add("copy", 10'000'000, [=](benchmark::State& state, std::size_t n) {
    const auto& context = device.context();
    const detail::DeviceBuffer from(*context, 12 * n, detail::BufferUse::device),
        to(*context, 12 * n, detail::BufferUse::device);
    constexpr std::size_t copies = 8;
    measure(state, copies * n, false, [&] {
      detail::Submission submission(context);
      for (std::size_t i = 0; i < copies; ++i)
        submission.copy(from, 0, to, 0, 12 * n);
      submission.run();
    });
    state.counters["GB/s"] = 24e-3 * state.counters["Mpt/s"];
  });
}

bool same(const std::vector<Fitted<AnyVolume>>& a, const std::vector<Fitted<AnyVolume>>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.used == y.used && x.rank == y.rank && x.volume == y.volume;
  });
}

void add_clouds(const GpuDevice& device, std::size_t points) {
  for (const std::string name : {"aabb", "dop26", "sphere-epos26", "sphere-exact"}) {
    add(name, points, [=](benchmark::State& state, std::size_t n) {
      const Floats& xyz = cloud_of(n);
      const GpuCloud cloud(device, view_of(xyz));
      if (!same(fit(cloud, methods_named({name})), fit_methods(view_of(xyz), methods_named({name}))))
        return state.SkipWithError("the processor finds another volume");
      measure(state, n, true, [&] { benchmark::DoNotOptimize(fit(cloud, methods_named({name}))); });
    });
    add("processor-" + name, points, [=](benchmark::State& state, std::size_t n) {
      const Floats& xyz = cloud_of(n);
      measure(state, n, false, [&] {
        benchmark::DoNotOptimize(fit_methods(view_of(xyz), methods_named({name}), {}, {policy_of(2)}));
      });
    });
  }
  add("upload-and-dop26", points, [=](benchmark::State& state, std::size_t n) {
    const Floats& xyz = cloud_of(n);
    measure(state, n, false, [&] {
      const GpuCloud cloud(device, view_of(xyz), HostPoints::keep, {policy_of(2)});
      benchmark::DoNotOptimize(fit(cloud, methods_named({"dop26"})));
    });
  });
}

void add_clusters(const GpuDevice& device, std::size_t clusters) {
  constexpr std::size_t in_cluster = 100;
  const auto methods = methods_named({"aabb", "dop26"});
  add("clusters-of-100", clusters * in_cluster, [=](benchmark::State& state, std::size_t n) {
    const Floats& xyz = cloud_of(n);
    const GpuCloud cloud(device, view_of(xyz));
    const std::vector<std::size_t> offsets = offsets_of(n, in_cluster);
    measure(state, n, true,
            [&] { benchmark::DoNotOptimize(fit(cloud, offsets, methods, {}, {policy_of(2)}).size()); });
  });
  add("processor-clusters-of-100", clusters * in_cluster, [=](benchmark::State& state, std::size_t n) {
    const Floats& xyz = cloud_of(n);
    const std::vector<std::size_t> offsets = offsets_of(n, in_cluster);
    std::vector<PointView> views;
    for (std::size_t c = 0; c + 1 < offsets.size(); ++c)
      views.push_back(view_of(xyz).slice(offsets[c], in_cluster));
    measure(state, n, false, [&] {
      for_each_view(views,
                    [&](std::size_t i, const Execution& own) {
                      benchmark::DoNotOptimize(fit_methods(views[i], methods, {}, own));
                    },
                    {policy_of(2)});
    });
  });
}

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// The rows gpu/tree and gpu/refit-tree count points. The rows gpu/nearest count queries.
void add_trees(const GpuDevice& device, std::size_t points) {
  add("tree", points, [=](benchmark::State& state, std::size_t n) {
    const Floats& xyz = cloud_of(n);
    const GpuCloud cloud(device, view_of(xyz));
    measure(state, n, true, [&] { benchmark::DoNotOptimize(GpuTree(cloud).size()); });
  });
  add("refit-tree", points, [=](benchmark::State& state, std::size_t n) {
    const Floats& xyz = cloud_of(n);
    const GpuCloud cloud(device, view_of(xyz));
    GpuTree tree(cloud);
    measure(state, n, true, [&] { tree.refit(cloud); });
  });
  add("processor-tree", points, [=](benchmark::State& state, std::size_t n) {
    const Floats& xyz = cloud_of(n);
    PointTree tree;
    measure(state, n, false, [&] { tree.assign(view_of(xyz), {policy_of(2)}); });
  });
  add("nearest", points, [=](benchmark::State& state, std::size_t n) {
    const Floats xyz = cloud_of(n), queries = make_cloud(n / 10);
    const GpuTree tree(GpuCloud(device, view_of(xyz)));
    std::vector<Neighbor> found;
    measure(state, n / 10, false, [&] { nearest(tree, view_of(queries), found, kNoLimit, {policy_of(2)}); });
  });
  add("processor-nearest", points, [=](benchmark::State& state, std::size_t n) {
    const Floats xyz = cloud_of(n), queries = make_cloud(n / 10);
    const PointTree tree(view_of(xyz));
    std::vector<Neighbor> found;
    measure(state, n / 10, false, [&] { nearest(tree, view_of(queries), found, kNoLimit, {policy_of(2)}); });
  });
}

void add_rows() {
  const char* const which = std::getenv("PCL_BV_GPU");
  const GpuDevice device(which == nullptr ? "0" : which);
  benchmark::AddCustomContext("gpu", device.info().name);
  const bool software = device.info().kind == GpuKind::software;
  add_copy(device);
  for (const std::size_t points : {128'000, 1'000'000, 10'000'000, 100'000'000}) {
    if (software && points > 1'000'000) continue;
    add_clouds(device, points);
    add_trees(device, points);
  }
  add_clusters(device, software ? 10'000 : 1'000'000);
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  try {
    pcl_bv::bench::add_rows();
  } catch (const pcl_bv::GpuError& error) {
    std::fprintf(stderr, "no rows: %s\n", error.what());
    return 0;
  }
  return pcl_bv::bench::run_program(argc, argv);
}
