// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/frame_pipeline.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include "class_table.h"
#include "deskew/deskewer.h"
#include "extent_limits.h"
#include "filter.h"
#include "ground.h"
#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/select_points.h"
#include "pcl_bv/segmentation/ground.h"
#include "pcl_bv/segmentation/up.h"
#include "pipeline/config/check.h"
#include "refine/cluster_refiner.h"
#include "reserve_ahead.h"
#include "synthetic_sweep.h"
#include "tracked_volumes.h"

namespace pcl_bv {
using namespace detail;
namespace {

class Stopwatch {
 public:
  double lap() {  // milliseconds since the last lap(), or since construction
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// A valid configuration and the data derived from it.
struct Prepared {
  PipelineConfig config;
  std::vector<const Method*> methods;
  ClassTable classes;
  MethodOptions options;
  std::shared_ptr<const PointFilter> filter;
  Execution execution{Serial{}, Isa::scalar};  // replaced by the configured instruction set
  bool segments = false;                       // ground removal or clustering is enabled
  bool reads_points = false;                   // some stage reads the points before the fits
};

std::shared_ptr<const Prepared> prepare(PipelineConfig config) {
  throw_if_any(problems_of(config));
  auto prepared = std::make_shared<Prepared>();
  prepared->methods = config.methods();
  prepared->classes = ClassTable(config);
  prepared->options = config.method_options();
  prepared->segments = config.ground.method != GroundMethod::none || config.cluster.tolerance > 0;
  prepared->execution = config.execution();
  prepared->filter = std::make_shared<PointFilter>(config.filter, prepared->execution.isa);
  prepared->reads_points = prepared->segments || !prepared->filter->keeps_all() ||
                           config.cluster.effective_min_size() > 0 ||
                           config.cluster.max_size < std::numeric_limits<std::size_t>::max();
  prepared->config = std::move(config);
  return prepared;
}

}  // namespace

struct FramePipeline::State {
  std::shared_ptr<const Prepared> current() const {
    const std::lock_guard lock(mutex);
    return prepared;
  }

  PointView filter(const Prepared& now, const Frame& frame, FrameResult& result);
  const Frame& deskew(const Prepared& now, const Frame& frame, FrameResult& result);
  void begin(const Frame& frame);
  void remember_pose(const Prepared& now, const Frame& frame, bool tracked);
  void find_sensor(const Prepared& now, const Frame& frame, FrameResult& result);
  PointView remove_ground(const Prepared& now, const Frame& frame, const PointView& points,
                          FrameResult& result);
  void find_clusters(const Prepared& now, const Frame& frame, const PointView& points, FrameResult& result);
  void refine_clusters(const Prepared& now, const Frame& frame, FrameResult& result);
  void make_views(const PointView& cloud, const FrameResult& result);
  void limit_extents(const Prepared& now, const PointView& cloud, FrameResult& result);
  void find_supports_by_device(const Prepared& now);
  void fit(const Prepared& now, const PointView& cloud, FrameResult& result);

  mutable std::mutex mutex;
  std::shared_ptr<const Prepared> prepared;

  Deskewer deskewer;
  Frame moved;  // the frame with the points that were moved
  PointParts<FilterPart> parts;
  GroundZones zones;
  EuclideanClusterer clusterer;
  ClassClusterer class_clusterer;
  ClusterRefiner refiner;
  std::vector<PointView> views;  // points of each cluster
  std::shared_ptr<SupportFinder> supports_by_device;
  ExtentLimits extents;
  TrackedVolumes tracks;
  std::uint64_t pass = 0;  // of the last frame
  FrameWarnings warnings;
};

// If a large cloud needs only the filter, the cloud is filtered chunk by chunk whenever its points are
// loaded. Clouds in memory are treated like clouds in files, so that both kinds give the same bits.
PointView FramePipeline::State::filter(const Prepared& now, const Frame& frame, FrameResult& result) {
  const PointView& cloud = frame.points;
  result.passed_filter.clear();
  result.filtered.reset();
  if (!now.reads_points) return cloud;
  auto filter = now.filter;
  if (!frame.recorded_origin.isZero(0))
    filter = std::make_shared<const PointFilter>(filter->with_origin(frame.recorded_origin));
  const bool listed = now.segments || cloud.indices != nullptr;
  if (!listed && (cloud.source != nullptr || cloud.count > kChunkPoints)) {
    auto filtered = std::make_shared<FilteredPoints>(cloud, frame.owner, filter, frame.sensors);
    result.counts = filtered->count(now.execution.parallel);
    result.filtered = std::move(filtered);
  } else {
    filter->select(cloud, frame.sensors, now.execution.parallel, result.passed_filter, parts, result.counts);
  }
  return result.points_after_filter(cloud);
}

// Returns the frame with which later stages work. The filter comes before: points on the vehicle itself move
// with the sensor, so they must not be moved.
const Frame& FramePipeline::State::deskew(const Prepared& now, const Frame& frame, FrameResult& result) {
  result.deskew = {};
  if (now.config.deskew == Deskew::off || !now.segments) return frame;
  deskewer.apply(frame, now.execution, result.deskew);
  if (!result.deskew.moved()) return frame;
  moved.header = frame.header;
  moved.points = result.deskew.points;
  moved.classes = frame.classes;
  moved.pose = frame.pose;
  moved.sensor = frame.sensor;
  moved.recorded_origin = frame.recorded_origin;
  moved.sensors = frame.sensors;
  moved.recorded_ns = frame.recorded_ns;
  return moved;
}

// Forgets the frames of an earlier pass over the source. Another pass does not continue them.
void FramePipeline::State::begin(const Frame& frame) {
  if (std::exchange(pass, frame.pass) == frame.pass) return;
  tracks.reset();
  deskewer.reset();
}

// Tells the deskewer the pose of the frame: its own one or, if it was tracked, the tracker's.
void FramePipeline::State::remember_pose(const Prepared& now, const Frame& frame, bool tracked) {
  if (now.config.deskew == Deskew::off || (!frame.pose && !tracked)) return deskewer.reset();
  deskewer.remember(frame.pose ? *frame.pose : tracks.sensor(), frame.header.stamp_ns,
                    frame.pose.has_value());
}

// In a merged cloud, ranges are measured from each sensor, and the origin of the robot need not be one of
// them. Uses ground.sensor without a check. Uses Frame::sensor only if the points lie around this position.
void FramePipeline::State::find_sensor(const Prepared& now, const Frame& frame, FrameResult& result) {
  const PipelineConfig& config = now.config;
  result.sensor = {frame.recorded_origin};
  result.around_origin = true;
  const bool counts_from_origin = config.filter.range_max < std::numeric_limits<double>::infinity() ||
                                  config.cluster.tolerance_per_metre > 0;
  if (frame.points.source != nullptr) return;
  if (config.ground.method != GroundMethod::zones && !counts_from_origin) return;
  const auto find_around = [&](const Eigen::Vector3d& position) {
    return pcl_bv::find_sensor(frame.points, config.ground.up, position, result.ground.scratch);
  };
  result.sensor = find_around(frame.recorded_origin);
  result.around_origin = result.sensor.confirmed || !frame.sensors.empty();
  if (config.ground.sensor) {
    result.sensor = find_around(*config.ground.sensor);
    result.sensor.position = *config.ground.sensor;
  } else if (frame.sensor) {
    const SensorPosition stated = find_around(*frame.sensor);
    if (stated.confirmed) result.sensor = stated;
  }
}

PointView FramePipeline::State::remove_ground(const Prepared& now, const Frame& frame,
                                              const PointView& points, FrameResult& result) {
  const GroundConfig& config = now.config.ground;
  split_ground(points, config, result.sensor, frame.recorded_origin, now.execution, zones, result.ground);
  result.ground.sensor = result.sensor;
  if (config.method == GroundMethod::none) return points;
  result.counts.ground = result.ground.ground.size();
  return select_points(points, result.ground.rest);
}

// Makes one cluster of all points. If this cluster would be too small or too large, makes no cluster.
void make_one_cluster(const ClusterConfig& config, const PointView& points, FrameResult& result) {
  const Counts& counts = result.counts;
  const std::size_t valid = result.points - counts.nonfinite - counts.range - counts.inside - counts.ground;
  Clusters& all = result.clusters;
  all.indices.clear();
  all.offsets.assign(1, 0);
  const bool small = valid < config.effective_min_size();
  const bool large = valid > config.max_size && config.oversized != Oversized::keep;
  all.small_points = small ? valid : 0;
  all.large_points = large ? valid : 0;
  all.noise_points = all.class_points = 0;
  if (small || large) return;
  all.offsets.push_back(valid);
  if (points.indices != nullptr && points.count == valid)
    all.indices.assign(points.indices, points.indices + points.count);
}

void FramePipeline::State::make_views(const PointView& cloud, const FrameResult& result) {
  views.clear();
  for (std::size_t i = 0; i < result.clusters.size(); ++i)
    views.push_back(result.points_of(i, cloud));
}

void FramePipeline::State::limit_extents(const Prepared& now, const PointView& cloud, FrameResult& result) {
  const ClusterConfig& config = now.config.cluster;
  if (!config.min_extent && !config.max_extent) return;
  make_views(cloud, result);
  extents.apply(config, now.options.up, views, now.execution, result.clusters, result.class_of,
                result.refinements);
}

void FramePipeline::State::find_clusters(const Prepared& now, const Frame& frame, const PointView& points,
                                         FrameResult& result) {
  const ClusterConfig& config = now.config.cluster;
  std::optional<ClassTable> moved_classes;
  if (!frame.recorded_origin.isZero(0)) moved_classes = now.classes.with_origin(frame.recorded_origin);
  const ClassTable& classes = moved_classes ? *moved_classes : now.classes;
  result.class_of.clear();
  if (config.tolerance == 0) {
    make_one_cluster(config, points, result);
  } else if (!config.class_field) {
    clusterer.extract(points, classes.default_options(), result.clusters, now.execution);
  } else {
    if (frame.classes == nullptr)
      throw std::invalid_argument("the frame has no classes, but cluster.class_field is '" +
                                  config.class_field->name + "'");
    class_clusterer.extract(points, *frame.classes, classes.default_options(), classes.class_options(),
                            result.clusters, result.class_of, now.execution);
  }
  refine_clusters(now, frame, result);
  limit_extents(now, frame.points, result);
  // Frees the memory of the clustering before the fits. Otherwise the clustering and the volumes would be in
  // memory at the same time: 550 MB and 300 MB for a million clusters of four points.
  constexpr std::size_t many = 250'000;
  if (result.clusters.size() >= many) {
    clusterer = EuclideanClusterer();
    class_clusterer = ClassClusterer();
  }
  result.counts.small = result.clusters.small_points;
  result.counts.large = result.clusters.large_points;
  result.counts.noise = result.clusters.noise_points;
  result.counts.dropped_class = result.clusters.class_points;
}

void FramePipeline::State::refine_clusters(const Prepared& now, const Frame& frame, FrameResult& result) {
  const ClusterConfig& config = now.config.cluster;
  const Refine refine = now.config.effective_refine();
  result.refinements.clear();
  if (refine == Refine::off || config.tolerance == 0) return;
  const RefineOptions options{now.options.up,
                              result.sensor.position,
                              &frame.sensors,
                              config.effective_min_size(),
                              &now.classes.class_options(),
                              now.execution.isa,
                              now.execution.parallel};
  refiner.cut_at_necks(frame.points, options, result.clusters, result.class_of, result.refinements,
                       result.counts);
  if (refine != Refine::tracks || !now.config.track.enabled) return;
  make_views(frame.points, result);
  const std::vector<KnownObject>& known = tracks.predict(views, frame);
  refiner.follow_tracks(frame.points, options, tracks.sensor(), known, result.clusters, result.class_of,
                        result.refinements, result.counts);
}

// Lets the device, if there is one, find the supports that any class of clusters needs.
void FramePipeline::State::find_supports_by_device(const Prepared& now) {
  const std::optional<DirectionSet> set = directions_of(now.methods);
  if (supports_by_device != nullptr && set) supports_by_device->find(views, *set, now.execution);
}

void FramePipeline::State::fit(const Prepared& now, const PointView& cloud, FrameResult& result) {
  make_views(cloud, result);
  find_supports_by_device(now);
  const std::size_t methods = now.methods.size();
  result.methods.assign(now.methods.begin(), now.methods.end());
  reserve_ahead(result.volumes, views.size() * methods);
  reserve_ahead(result.results, views.size() * methods);
  reserve_ahead(result.requested, views.size() * methods);
  result.volumes.resize(views.size() * methods);
  result.results.resize(result.volumes.size());
  result.requested.resize(result.volumes.size());
  const auto fit_cluster = [&](std::size_t cluster, const Execution& execution) {
    const std::vector<const Method*>& requested_methods = now.classes.methods_of(
        result.class_of.empty() ? std::nullopt : std::optional(result.class_of[cluster]));
    const FitExecution known =
        supports_by_device ? supports_by_device->known(cluster, execution) : FitExecution(execution);
    detail::Supports supports;
    const detail::FitExecution shared =
        detail::share_supports(views[cluster], requested_methods, known, supports);
    for (std::size_t m = 0; m < methods; ++m) {
      const std::size_t i = cluster * methods + m;
      result.requested[i] = std::find(requested_methods.begin(), requested_methods.end(), now.methods[m]) !=
                            requested_methods.end();
      if (result.requested[i] == 0) {
        result.volumes[i] = AnyVolume();
        result.results[i] = EstimationResult();
        continue;
      }
      result.results[i] =
          detail::fit_method(*now.methods[m], views[cluster], now.options, result.volumes[i], shared);
    }
  };
  for_each_view(views, std::cref(fit_cluster), now.execution);
  if (now.reads_points) return;
  result.counts.nonfinite = result.results.front().dropped;  // no earlier stage has counted nonfinite points
  result.clusters.offsets.back() = result.results.front().used;
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

void FramePipeline::set_warnings(FrameWarnings warnings) {
  state_->warnings = std::move(warnings);
}

void FramePipeline::set_support_finder(std::shared_ptr<SupportFinder> finder) {
  state_->supports_by_device = std::move(finder);
}

std::optional<std::vector<Aabb>> FramePipeline::kept_extents() const {
  return state_->current()->filter->kept_extents();
}

void FramePipeline::process(const Frame& frame, FrameResult& result) {
  const FloatEnvironment environment;
  const std::shared_ptr<const Prepared> now = state_->current();
  const SpinningThreads awake(now->execution.parallel);
  Stopwatch whole, watch;
  result.header = frame.header;
  result.config = {now, &now->config};
  result.points = frame.points.count;
  result.counts = Counts();
  result.ms = StageTimes();
  result.ms.decode = frame.decode_ms;
  state_->begin(frame);

  if (now->segments && frame.points.source != nullptr)
    throw std::invalid_argument(
        "a cloud that is not in memory can be filtered, but ground removal and clustering need it in memory");
  PointView points = state_->filter(*now, frame, result);
  const Frame& used = state_->deskew(*now, frame, result);
  if (result.deskew.moved()) points = result.points_after_filter(used.points);
  result.ms.filter = watch.lap();
  state_->find_sensor(*now, used, result);
  points = state_->remove_ground(*now, used, points, result);
  result.ms.ground = watch.lap();
  state_->find_clusters(*now, used, points, result);
  result.ms.cluster = watch.lap();
  state_->fit(*now, used.points, result);
  result.ms.fit = watch.lap();
  result.tracks.clear();
  result.active_tracks.clear();
  result.track_time = TrackTime::stamps;
  // An empty cluster has no position to track.
  const bool nothing = result.clusters.size() == 1 && result.clusters.list_size(0) == 0;
  if (now->config.track.enabled && nothing) result.tracks.resize(result.clusters.size());
  const bool tracked = now->config.track.enabled && !nothing;
  if (tracked) {
    state_->tracks.update(now->config.track, now->execution.isa, state_->views, used, result);
    if (result.track_time == TrackTime::restarted) state_->deskewer.reset();
  } else {
    state_->tracks.reset();
  }
  state_->remember_pose(*now, used, tracked);
  result.ms.track = watch.lap();
  result.ms.total = whole.lap();
  result.warnings = state_->warnings.take(frame, result);
}

void FramePipeline::reserve(std::size_t points, FrameResult& result) {
  const Frame frame = synthetic_sweep(points, state_->current()->config);
  const FrameWarnings warnings = state_->warnings;
  for (int pass = 0; pass < 2; ++pass)  // the first pass creates tracks, the second one updates them
    process(frame, result);
  state_->tracks = TrackedVolumes();
  state_->deskewer.reset();
  state_->warnings = warnings;
}

}  // namespace pcl_bv
