// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// AABB and k-DOPs of pcl::PointXYZ on each instruction set, beside pcl::getMinMax3D. Results are checked,
// then timed.

#include <benchmark/benchmark.h>
#include <pcl/common/common.h>
#include <pcl/point_types.h>

#include <random>
#include <stdexcept>
#include <string>

#include "pcl_bv/estimation/fit_cloud.h"

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

Cloud gaussian_cloud(std::size_t points) {
  std::mt19937_64 random(1);
  std::normal_distribution<float> normal;
  Cloud cloud;
  for (std::size_t i = 0; i < points; ++i)
    cloud.push_back({normal(random), normal(random), normal(random)});
  return cloud;
}

void count_points(benchmark::State& state, std::size_t points) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points));
}

void pcl_aabb(benchmark::State& state, bool dense) {
  Cloud cloud = gaussian_cloud(static_cast<std::size_t>(state.range(0)));
  cloud.is_dense = dense;
  pcl::PointXYZ low, high;
  for (auto _ : state) {
    pcl::getMinMax3D(cloud, low, high);
    benchmark::DoNotOptimize(low);
    benchmark::DoNotOptimize(high);
  }
  count_points(state, cloud.size());
}

void our_aabb(benchmark::State& state, pcl_bv::Isa isa) {
  const Cloud cloud = gaussian_cloud(static_cast<std::size_t>(state.range(0)));
  const pcl_bv::Execution execution{pcl_bv::Serial{}, isa};
  pcl_bv::Aabb box;
  pcl_bv::fit_aabb(cloud, box, execution);
  pcl::PointXYZ low, high;
  pcl::getMinMax3D(cloud, low, high);
  if (box.min().cast<float>() != low.getVector3fMap() || box.max().cast<float>() != high.getVector3fMap()) {
    throw std::logic_error("the boxes differ");
  }
  for (auto _ : state) {
    pcl_bv::fit_aabb(cloud, box, execution);
    benchmark::DoNotOptimize(box);
  }
  count_points(state, cloud.size());
}

void our_dop26(benchmark::State& state, pcl_bv::Isa isa) {
  const Cloud cloud = gaussian_cloud(static_cast<std::size_t>(state.range(0)));
  const pcl_bv::Execution execution{pcl_bv::Serial{}, isa};
  pcl_bv::Kdop kdop;
  pcl_bv::fit_kdop(cloud, pcl_bv::KdopSet::dop26(), kdop, execution);
  for (const auto& p : cloud) {
    if (!kdop.contains(p.getVector3fMap().cast<double>())) throw std::logic_error("a point is outside");
  }
  for (auto _ : state) {
    pcl_bv::fit_kdop(cloud, pcl_bv::KdopSet::dop26(), kdop, execution);
    benchmark::DoNotOptimize(kdop);
  }
  count_points(state, cloud.size());
}

void our_epos26(benchmark::State& state, pcl_bv::Isa isa) {
  const Cloud cloud = gaussian_cloud(static_cast<std::size_t>(state.range(0)));
  const pcl_bv::Execution execution{pcl_bv::Serial{}, isa};
  pcl_bv::Sphere sphere;
  for (auto _ : state) {
    pcl_bv::fit_sphere(cloud, pcl_bv::SphereMethod::epos26, sphere, execution);
    benchmark::DoNotOptimize(sphere);
  }
  count_points(state, cloud.size());
}

}  // namespace

int main(int argc, char** argv) {
  constexpr std::int64_t sizes[] = {300, 4010, 100'722, 1'000'000};
  for (const std::int64_t size : sizes) {
    const std::string suffix = "/n:" + std::to_string(size);
    const auto add = [&](const std::string& name, auto function, auto argument) {
      benchmark::RegisterBenchmark((name + suffix).c_str(), function, argument)
          ->Arg(size)
          ->Unit(benchmark::kMicrosecond);
    };
    add("getMinMax3D/dense", pcl_aabb, true);
    add("getMinMax3D/non-dense", pcl_aabb, false);
    for (const pcl_bv::Isa isa : pcl_bv::usable_isas()) {
      add("aabb/" + std::string(pcl_bv::isa_name(isa)), our_aabb, isa);
      add("dop26/" + std::string(pcl_bv::isa_name(isa)), our_dop26, isa);
      add("sphere-epos26/" + std::string(pcl_bv::isa_name(isa)), our_epos26, isa);
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
