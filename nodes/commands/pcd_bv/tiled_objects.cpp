// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tiled_objects.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "commands/shared/messages.h"
#include "loaded_cloud.h"
#include "object_files.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/segmentation/stored_clusters.h"
#include "pipeline/class_table.h"
#include "pipeline/extent_limits.h"
#include "pipeline/filtered_view.h"
#include "process.h"
#include "tiles.h"

namespace pcl_bv::detail {
namespace {

// Bytes that a point in memory takes while a brick is clustered.
constexpr std::size_t bytes_per_point(ScalarType scalar) {
  return scalar == ScalarType::float32 ? 150 : 250;
}
// Clusters with more points use all threads for each fit. Smaller ones are distributed over the threads.
constexpr std::size_t kManyPoints = 200'000;
// Clusters that a thread takes at a time.
constexpr std::size_t kAtATime = 16;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// A cluster with its volumes, or why it is dropped.
struct Object {
  ExtentVerdict verdict = ExtentVerdict::keep;
  ClusterEntry entry;
};

class ObjectFitter {
 public:
  ObjectFitter(const StoredClusters& clusters, const Options& options)
      : clusters_(clusters),
        options_(options),
        methods_(options.pipeline.methods()),
        method_options_(options.pipeline.method_options()) {}

  std::vector<Object> fit() const {
    std::vector<Object> objects(clusters_.size());
    const Execution execution = options_.pipeline.execution();
    std::size_t first_small = 0;  // clusters are sorted by size
    for (; first_small < objects.size() && clusters_.point_count(first_small) > kManyPoints; ++first_small)
      fit(first_small, execution, objects[first_small]);
    const Execution serial{Serial{}, execution.isa};
    for_each_range(execution.parallel, objects.size() - first_small, kAtATime,
                   [&](std::size_t begin, std::size_t end) {
                     for (std::size_t i = first_small + begin; i < first_small + end; ++i)
                       fit(i, serial, objects[i]);
                   });
    return objects;
  }

 private:
  void fit(std::size_t cluster, const Execution& execution, Object& object) const {
    const StoredClusters::Points points = clusters_.points(cluster);
    object.verdict = extent_verdict(points.view(), options_.pipeline.cluster, method_options_.up, execution);
    if (object.verdict != ExtentVerdict::keep) return;
    object.entry.points = points.view().count;
    std::vector<Fitted<AnyVolume>> fits = fit_methods(points.view(), methods_, method_options_, execution);
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      VolumeEntry& entry = object.entry.volumes.emplace_back();
      entry.method = methods_[m]->name;
      entry.failed = fits[m].reason;
      entry.volume = std::move(fits[m].volume);
      if (options_.check && entry.failed.empty())
        entry.outside = verify(entry.volume, points.view(), execution).outside;
    }
  }

  const StoredClusters& clusters_;
  const Options& options_;
  std::vector<const Method*> methods_;
  MethodOptions method_options_;
};

// Returns the number of the cluster of each reported object.
std::vector<std::size_t> add_objects(const StoredClusters& clusters, std::vector<Object> objects,
                                     Report& report) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    Object& object = objects[i];
    if (object.verdict == ExtentVerdict::small) report.counts.small += clusters.point_count(i);
    if (object.verdict == ExtentVerdict::large) report.counts.large += clusters.point_count(i);
    if (object.verdict != ExtentVerdict::keep) continue;
    object.entry.id = report.clusters.size();
    report.clusters.push_back(std::move(object.entry));
    numbers.push_back(i);
  }
  return numbers;
}

// Finds the clusters of a cloud, whose points may be in files, fits the volumes and writes the points of
// objects.
Status add_objects_of(const PointView& cloud, const Job& job, const Options& options, Report& report) {
  const Clock::time_point begin = Clock::now();
  const PipelineConfig& config = options.pipeline;
  const Execution execution = config.execution();
  const FilteredView filtered = filter_points(cloud, config.filter, execution);
  const StoredClusters clusters(
      filtered.points, ClassTable(config).default_options(),
      {std::max<std::size_t>(options.memory_bytes / bytes_per_point(cloud.scalar), 1), {}}, execution);
  report.points = cloud.count;
  report.counts = clusters.counts();
  if (filtered.owner != nullptr) {  // dropped points count as not finite then
    report.counts.nonfinite = filtered.counts.nonfinite;
    report.counts.range = filtered.counts.range;
    report.counts.inside = filtered.counts.inside;
  }
  const double segment = seconds_since(begin);
  report.clusters.clear();
  const std::vector<std::size_t> numbers =
      add_objects(clusters, ObjectFitter(clusters, options).fit(), report);
  if (options.timings) report.seconds = {0, segment, seconds_since(begin) - segment};
  if (!job.objects) return Status::done;
  return write_objects(*job.objects, numbers.size(), execution.parallel, [&](std::size_t id) {
    write_object(*job.objects, id, clusters.points(numbers[id]).view());
  });
}

}  // namespace

Status process_tiled_objects(const Job& job, const Options& options, Report& report) {
  const Execution execution = options.pipeline.execution();
  LoadedCloud loaded(job, false, execution, options.origin);
  report.parts = job.tiles->included_count();
  report.origin = loaded.origin();
  Status written = Status::done;
  try {
    written = add_objects_of(loaded.xyz(), job, options, report);
  } catch (const TileError&) {
    throw;
  } catch (...) {
    loaded.require_unchanged();  // a file that was changed is the better explanation
    throw;
  }
  FrameResult counted;
  counted.config = std::make_shared<PipelineConfig>(options.pipeline);
  counted.points = report.points;
  counted.counts = report.counts;
  const std::string range = range_warning(counted, options.range_from);
  if (!range.empty()) report_problem(job.input + ": " + range);
  if (options.info) {
    const RawCloud& cloud = loaded.cloud();
    report.info =
        CloudInfo{cloud_statistics(loaded.xyz(), execution), cloud.width, cloud.height, cloud.fields};
  }
  Aabb box;
  for (const ClusterEntry& cluster : report.clusters)
    if (!cluster.volumes.empty()) box.merge(aabb(cluster.volumes.front().volume));
  const std::string coarse = coarse_warning(box, loaded.xyz().scalar);
  if (!coarse.empty()) report_problem(job.input + ": " + coarse);
  loaded.require_unchanged();
  return worse(written, worse(report_failures(report), write_mesh(job, report.clusters)));
}

}  // namespace pcl_bv::detail
