// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The whole way from a cloud in memory to volumes, frame by frame, and PCL's own way beside it. The sequences
// are synth:street-sequence, the same street seen by 128 beams and, where PCL_BV_DATA names a folder with
// lidar_sequence in it, its sweeps. Back to back, and `paced`: a frame every 100 ms, as a robot gets them.
// Counters: milliseconds of a frame at the 50th and 99th percentile and at most, the first five apart
// (`first_max`), and of each stage at the median.

#include <benchmark/benchmark.h>
#ifdef PCL_BV_BENCH_SEGMENTATION
#include <pcl/features/moment_of_inertia_estimation.h>
#include <pcl/filters/extract_indices.h>
#include <pcl/segmentation/extract_clusters.h>
#include <pcl/segmentation/sac_segmentation.h>
#endif

#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <thread>

#include "pcl_bv/nodes/cluster_pipeline.h"
#include "pcl_bv/nodes/frame_source.h"
#include "pcl_bv/nodes/stream_runner.h"
#include "pcl_bv/synth/street.h"
#include "program.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

constexpr std::size_t kWarmUp = 5;
constexpr int kFrames = 159;
constexpr std::chrono::milliseconds kPeriod{100};

const std::string kBeams128 = "128 beams";

Frame frame_of_128_beams(std::size_t number) {
  StreetOptions options;
  options.points = 250'000;
  options.beams = 128;
  const auto xyz = std::make_shared<std::vector<float>>(make_street_frame(options, number).cloud.xyz);
  Frame frame;
  frame.points = PointView::of(xyz->data(), 3 * sizeof(float), xyz->size() / 3);
  frame.owner = xyz;
  return frame;
}

const std::vector<Frame>& frames_of(const std::string& source) {
  static std::string loaded;
  static std::vector<Frame> frames;
  if (loaded == source) return frames;
  frames.clear();
  if (source == kBeams128) {
    for (std::size_t i = 0; i < (tiny() ? 1U : 40U); ++i)
      frames.push_back(frame_of_128_beams(i));
  } else {
    const std::unique_ptr<FrameSource> stream = open_source(source);
    for (Frame frame; stream->next(frame, std::chrono::seconds(1)) == Next::frame;)
      frames.push_back(frame);
  }
  loaded = source;
  return frames;
}

double milliseconds(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

void show(benchmark::State& state, const std::string& name, const LatencyHistogram& ms) {
  state.counters[name + "_p50"] = ms.percentile(0.5);
  state.counters[name + "_p99"] = ms.percentile(0.99);
}

void pipeline(benchmark::State& state, const std::string& source, std::size_t threads, bool paced,
              const std::vector<std::string>& volumes = {"aabb", "sphere", "obb-yaw", "dop26"}) {
  const std::vector<Frame>& frames = frames_of(source);
  PipelineConfig config;
  config.volumes = volumes;
  config.track.enabled = true;
  config.threads = threads;
  FramePipeline pipeline(config);
  FrameResult result;
  pipeline.reserve(frames.front().points.count, result);
  LatencyHistogram first, total, filter, ground, cluster, fit, track;
  std::size_t n = 0, clusters = 0, points = 0;
  auto due = std::chrono::steady_clock::now();
  for (auto _ : state) {
    if (paced && !tiny()) std::this_thread::sleep_until(due += kPeriod);
    Frame frame = frames[n % frames.size()];
    frame.header.stamp_ns = static_cast<std::int64_t>(n) * 100'000'000;
    const double ms = milliseconds([&] { pipeline.process(frame, result); });
    state.SetIterationTime(1e-3 * ms);
    clusters += result.clusters.size();
    points += result.points;
    if (n++ < kWarmUp) {
      first.add(ms);
      continue;
    }
    total.add(ms);
    filter.add(result.ms.filter);
    ground.add(result.ms.ground);
    cluster.add(result.ms.cluster);
    fit.add(result.ms.fit);
    track.add(result.ms.track);
  }
  state.counters["first_max"] = first.max();
  state.counters["max"] = total.max();
  state.counters["clusters"] = static_cast<double>(clusters) / static_cast<double>(n);
  state.counters["points"] = static_cast<double>(points) / static_cast<double>(n);
  show(state, "total", total);
  show(state, "filter", filter);
  show(state, "ground", ground);
  show(state, "cluster", cluster);
  show(state, "fit", fit);
  show(state, "track", track);
}

#ifdef PCL_BV_BENCH_SEGMENTATION
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

Cloud::Ptr in_range(const Frame& frame) {
  const Cloud::Ptr cloud(new Cloud);
  for (std::size_t i = 0; i < frame.points.count; ++i) {
    const Coordinates p = load_point(frame.points, i);
    if (is_valid(p) && p.x * p.x + p.y * p.y + p.z * p.z >= 0.25)
      cloud->emplace_back(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
  }
  return cloud;
}

// What its tutorials say: one plane by RANSAC, clusters by a tree, boxes by moments of inertia.
std::size_t as_pcl_does(const Cloud::Ptr& cloud) {
  pcl::SACSegmentation<pcl::PointXYZ> plane;
  plane.setModelType(pcl::SACMODEL_PLANE);
  plane.setMethodType(pcl::SAC_RANSAC);
  plane.setDistanceThreshold(0.2);
  plane.setMaxIterations(100);
  plane.setInputCloud(cloud);
  const pcl::PointIndices::Ptr ground(new pcl::PointIndices);
  pcl::ModelCoefficients coefficients;
  plane.segment(*ground, coefficients);
  const Cloud::Ptr rest(new Cloud);
  pcl::ExtractIndices<pcl::PointXYZ> extract;
  extract.setInputCloud(cloud);
  extract.setIndices(ground);
  extract.setNegative(true);
  extract.filter(*rest);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> clusterer;
  clusterer.setClusterTolerance(0.5);
  clusterer.setMinClusterSize(10);
  clusterer.setInputCloud(rest);
  std::vector<pcl::PointIndices> clusters;
  clusterer.extract(clusters);
  for (const pcl::PointIndices& cluster : clusters) {
    pcl::MomentOfInertiaEstimation<pcl::PointXYZ> moments;
    moments.setInputCloud(rest);
    moments.setIndices(pcl::make_shared<const pcl::PointIndices>(cluster));
    moments.compute();
    pcl::PointXYZ low, high;
    moments.getAABB(low, high);
    benchmark::DoNotOptimize(low);
  }
  return clusters.size();
}

void pcl_way(benchmark::State& state, const std::string& source) {
  const std::vector<Frame>& frames = frames_of(source);
  LatencyHistogram total;
  std::size_t n = 0, clusters = 0;
  for (auto _ : state) {
    const Cloud::Ptr cloud = in_range(frames[n++ % frames.size()]);
    const double ms = milliseconds([&] { clusters += as_pcl_does(cloud); });
    state.SetIterationTime(1e-3 * ms);
    total.add(ms);
  }
  state.counters["clusters"] = static_cast<double>(clusters) / static_cast<double>(n);
  state.counters["max"] = total.max();
  show(state, "total", total);
}

#endif  // PCL_BV_BENCH_SEGMENTATION

void add_sequence(const std::string& name, const std::string& source) {
  const auto add_way = [&](const std::string& way, int frames, auto body) {
    benchmark::RegisterBenchmark(("pipeline/" + way + '/' + name).c_str(), body)
        ->Iterations(times_in_this_run(frames))
        ->Repetitions(1)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  };
  for (const std::size_t threads : {1, 2}) {
    for (const bool paced : {false, true}) {
      add_way((paced ? "paced-" : "") + std::to_string(threads) + "-thread", kFrames,
              [=](benchmark::State& state) { pipeline(state, source, threads, paced); });
    }
  }
  add_way("obb-min-1-thread", 20,
          [=](benchmark::State& state) { pipeline(state, source, 1, false, {"obb-min"}); });
#ifdef PCL_BV_BENCH_SEGMENTATION
  if (source != kBeams128) add_way("pcl", 3, [=](benchmark::State& state) { pcl_way(state, source); });
#endif
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  using namespace pcl_bv::bench;
  add_sequence("street", tiny() ? "synth:street-sequence:2" : "synth:street-sequence");
  add_sequence("street-128", kBeams128);
  const char* data = std::getenv("PCL_BV_DATA");
  if (data != nullptr && !tiny()) add_sequence("sweeps", std::string(data) + "/lidar_sequence");
  return run_program(argc, argv);
}
