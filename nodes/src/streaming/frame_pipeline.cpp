// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The stages in their order, each with its own watch.

#include "pcl_bv/nodes/frame_pipeline.h"

#include <chrono>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "pcl_bv/fitting/batch.h"
#include "pcl_bv/segmentation/euclidean_clusters.h"
#include "pcl_bv/segmentation/up.h"
#include "stages/filter.h"
#include "stages/ground.h"
#include "tracked_volumes.h"

namespace pcl_bv {
namespace {

class Watch {
 public:
  double lap() {  // milliseconds since the last call, or since construction
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// A configuration, checked and looked up.
struct Prepared {
  PipelineConfig config;
  std::vector<const Method*> methods;
  MethodOptions options;
  Execution execution{Serial{}, Isa::scalar};  // until the configuration's set is known
};

std::shared_ptr<const Prepared> prepare(PipelineConfig config) {
  std::string problems;
  for (const std::string& line : config.validate())
    problems += (problems.empty() ? "" : "; ") + line;
  if (!problems.empty()) throw std::invalid_argument(problems);
  auto prepared = std::make_shared<Prepared>();
  for (const std::string& name : config.volumes)
    prepared->methods.push_back(find_method(name));
  prepared->options.up = up_direction(config.ground.up);
  prepared->execution.isa = parse_isa(config.isa);
  if (config.threads != 1) prepared->execution.parallel = Threads{static_cast<unsigned>(config.threads)};
  prepared->config = std::move(config);
  return prepared;
}

PointView subset(PointView cloud, const std::int32_t* numbers, std::size_t count) {
  cloud.indices = numbers;
  cloud.count = count;
  return cloud;
}

PointView subset(const PointView& cloud, const std::vector<std::int32_t>& numbers) {
  return subset(cloud, numbers.data(), numbers.size());
}

}  // namespace

struct FramePipeline::State {
  std::shared_ptr<const Prepared> current() const {
    const std::lock_guard lock(mutex);
    return prepared;
  }

  PointView remove_ground(const GroundConfig& config, const PointView& points, FrameResult& result);
  void find_clusters(const Prepared& now, const PointView& points, FrameResult& result);
  void fit(const Prepared& now, const PointView& cloud, FrameResult& result);

  mutable std::mutex mutex;
  std::shared_ptr<const Prepared> prepared;

  std::vector<std::int32_t> kept;
  GroundZones zones;
  EuclideanClusterer clusterer;
  std::vector<PointView> views;
  TrackedVolumes tracks;
};

PointView FramePipeline::State::remove_ground(const GroundConfig& config, const PointView& points,
                                              FrameResult& result) {
  split_ground(points, config, zones, result.ground);
  if (config.method == GroundMethod::none) return points;
  result.counts.ground = result.ground.ground.size();
  return subset(points, result.ground.rest);
}

void FramePipeline::State::find_clusters(const Prepared& now, const PointView& points, FrameResult& result) {
  const ClusterConfig& config = now.config.cluster;
  Clusters& clusters = result.clusters;
  if (config.tolerance > 0) {
    const ClusterSettings settings{static_cast<float>(config.tolerance), config.min_size, config.max_size};
    clusterer.extract(points, settings, clusters, now.execution.parallel);
  } else {
    clusters.indices.assign(points.indices, points.indices + points.count);
    clusters.offsets.assign(1, 0);
    if (points.count > 0) clusters.offsets.push_back(points.count);
    clusters.small_points = clusters.large_points = 0;
  }
  result.counts.small = clusters.small_points;
  result.counts.large = clusters.large_points;
}

void FramePipeline::State::fit(const Prepared& now, const PointView& cloud, FrameResult& result) {
  views.clear();
  for (std::size_t i = 0; i < result.clusters.size(); ++i)
    views.push_back(subset(cloud, result.clusters.cluster(i), result.clusters.cluster_size(i)));
  const std::size_t methods = now.methods.size();
  result.methods.assign(now.methods.begin(), now.methods.end());
  result.volumes.resize(views.size() * methods);
  result.results.resize(result.volumes.size());
  const auto fit_cluster = [&](std::size_t cluster, const Execution& execution) {
    Supports supports;
    const Execution shared = share_supports(views[cluster], now.methods, execution, supports);
    for (std::size_t m = 0; m < methods; ++m) {
      const std::size_t i = cluster * methods + m;
      result.results[i] = now.methods[m]->fit(views[cluster], result.volumes[i], shared, now.options);
    }
  };
  for_each_view(views, now.execution, std::cref(fit_cluster));
}

FramePipeline::FramePipeline(PipelineConfig config) : state_(std::make_unique<State>()) {
  set_config(std::move(config));
}
FramePipeline::~FramePipeline() = default;
FramePipeline::FramePipeline(FramePipeline&&) noexcept = default;
FramePipeline& FramePipeline::operator=(FramePipeline&&) noexcept = default;

void FramePipeline::set_config(PipelineConfig config) {
  std::shared_ptr<const Prepared> prepared = prepare(std::move(config));
  const std::lock_guard lock(state_->mutex);
  state_->prepared.swap(prepared);
}

PipelineConfig FramePipeline::config() const {
  return state_->current()->config;
}

void FramePipeline::process(const Frame& frame, FrameResult& result) {
  const std::shared_ptr<const Prepared> now = state_->current();
  Watch whole, watch;
  result.header = frame.header;
  result.points = frame.points.count;
  result.counts = Counts();
  result.ms = StageTimes();
  result.ms.decode = frame.decode_ms;

  filter_points(frame.points, now->config.filter, state_->kept, result.counts);
  PointView points = subset(frame.points, state_->kept);
  result.ms.filter = watch.lap();
  points = state_->remove_ground(now->config.ground, points, result);
  result.ms.ground = watch.lap();
  state_->find_clusters(*now, points, result);
  result.ms.cluster = watch.lap();
  state_->fit(*now, frame.points, result);
  result.ms.fit = watch.lap();
  result.tracks.clear();
  if (now->config.track.enabled) {
    state_->tracks.update(now->config.track, state_->views, result);
  } else {
    state_->tracks.reset();
  }
  result.ms.track = watch.lap();
  result.ms.total = whole.lap();
}

}  // namespace pcl_bv
