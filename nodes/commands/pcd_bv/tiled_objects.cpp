// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tiled_objects.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "class_points.h"
#include "commands/shared/messages.h"
#include "loaded_cloud.h"
#include "object_fitter.h"
#include "object_list.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/segmentation/stored_clusters.h"
#include "pipeline/class_table.h"
#include "pipeline/extent_limits.h"
#include "pipeline/filtered_view.h"
#include "pipeline/ground_view.h"
#include "process.h"
#include "shifted_points.h"
#include "stopwatch.h"
#include "tiled_labels.h"
#include "tiles.h"

namespace pcl_bv::detail {
namespace {

// The points to be clustered, and the stages that have dropped others.
struct RemainingPoints {
  FilteredView filtered;
  GroundView ground;
  PointView points;
};

RemainingPoints remaining_points(const PointView& cloud, const std::optional<Eigen::Vector3d>& origin,
                                 const PipelineConfig& config) {
  RemainingPoints remaining;
  remaining.filtered = filter_points(cloud, config.filter, config.execution(), recorded_origin(origin));
  remaining.points = remaining.filtered.points;
  if (config.ground.method != GroundMethod::slope) return remaining;
  remaining.ground = remove_slope_ground(remaining.points, config.ground, config.execution());
  remaining.points = remaining.ground.points;
  return remaining;
}

// Sets the numbers of points that are dropped before the clustering, to which `valid` points are left.
void set_dropped_counts(const RemainingPoints& remaining, std::size_t valid, Report& report) {
  const bool filtered = remaining.filtered.owner != nullptr, ground = remaining.ground.owner != nullptr;
  const std::size_t before = ground ? remaining.ground.valid : valid;
  report.counts.nonfinite = filtered ? remaining.filtered.counts.nonfinite : remaining.points.count - before;
  report.counts.range = remaining.filtered.counts.range;
  report.counts.inside = remaining.filtered.counts.inside;
  report.counts.ground = before - valid;
}

class TiledObjects {
 public:
  TiledObjects(const Options& options, ScalarType scalar, Report& report)
      : options_(options),
        report_(report),
        list_(options, report),
        table_(options.pipeline),
        store_(store_options(options, scalar)) {}

  // Adds the objects of all classes.
  void add_classes(const ClassifiedPoints& cloud, const RemainingPoints& remaining) {
    const Classes classes = find_classes(cloud, table_, options_.pipeline.execution().parallel);
    report_.counts.dropped_class += classes.dropped;
    for (const auto& [value, clusters] : classes.kept)
      add_clusters(ClassPoints(cloud, value).view(), clusters, value);
    set_dropped_counts(remaining, classes.valid, report_);
  }

  // Adds the objects of points without classes.
  void add_all(const RemainingPoints& remaining) {
    const std::size_t invalid = add_clusters(remaining.points, table_.default_options(), std::nullopt);
    set_dropped_counts(remaining, remaining.points.count - invalid, report_);
  }

  ObjectList& list() { return list_; }
  double fit_seconds() const { return fit_seconds_; }

  // Returns the labels of points as labels_of() does.
  std::vector<std::uint32_t> labels(const RemainingPoints& remaining, std::size_t first,
                                    std::size_t count) const {
    std::vector<std::uint32_t> labels = list_.labels(first, count);
    if (remaining.ground.owner == nullptr) return labels;
    for (std::size_t done = 0; done < count; done += kChunkPoints) {
      const std::size_t n = std::min(count - done, kChunkPoints);
      const LoadedPoints before(remaining.filtered.points, first + done, n);
      const LoadedPoints after(remaining.points, first + done, n);
      for (std::size_t i = 0; i < n; ++i) {
        const bool ground = is_valid(load_point(before.view(), i)) && !is_valid(load_point(after.view(), i));
        if (ground) labels[done + i] = kLabelGround;
      }
    }
    return labels;
  }

 private:
  // Returns the number of points that are not valid.
  std::size_t add_clusters(const PointView& points, const ClusterOptions& options,
                           std::optional<std::int64_t> value) {
    ObjectFitter fitter(options_, table_, value);
    StoredClusterOptions store = store_;
    store.visit = [&](std::size_t brick, const std::vector<PointView>& found, const Execution& execution) {
      fitter.visit(brick, found, execution);
    };
    auto clusters = std::make_unique<StoredClusters>(points, options, store, options_.pipeline.execution());
    const std::size_t invalid = clusters->counts().nonfinite;
    const Stopwatch watch;
    std::vector<Object> objects = fitter.fit(*clusters);
    fit_seconds_ += watch.seconds();
    list_.add(std::move(clusters), std::move(objects));
    return invalid;
  }

  const Options& options_;
  Report& report_;
  ObjectList list_;
  ClassTable table_;
  StoredClusterOptions store_;
  double fit_seconds_ = 0;
};

// Finds the clusters of a cloud, whose points may be in files, fits the volumes and writes the points of
// objects.
Status add_objects_of(const PointView& cloud, const Job& job, const Options& options, Report& report) {
  const Stopwatch watch;
  const PipelineConfig& config = options.pipeline;
  report.points = cloud.count;
  report.counts = Counts();
  const RemainingPoints remaining = remaining_points(cloud, report.origin, config);
  TiledObjects objects(options, cloud.scalar, report);
  if (const auto& field = config.cluster.class_field) {
    objects.add_classes({remaining.points, *job.tiles, field->name}, remaining);
  } else {
    objects.add_all(remaining);
  }
  objects.list().write_report();
  const double all = watch.seconds();
  if (options.timings) report.seconds = {0, all - objects.fit_seconds(), objects.fit_seconds()};
  const Status written = job.objects ? objects.list().write_points(*job.objects) : Status::done;
  return worse(written, write_tile_labels(job, [&](std::size_t first, std::size_t count) {
                 return objects.labels(remaining, first, count);
               }));
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
  const std::string moved = origin_warning(loaded.origin(), false, options);
  if (!moved.empty()) report_problem(job.input + ": " + moved);
  report_ground_warning(report, options);
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
