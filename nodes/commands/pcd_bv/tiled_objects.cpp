// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tiled_objects.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>

#include "class_points.h"
#include "commands/shared/messages.h"
#include "commands/shared/setting_options.h"
#include "loaded_cloud.h"
#include "object_files.h"
#include "object_fitter.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/segmentation/stored_clusters.h"
#include "pipeline/class_table.h"
#include "pipeline/extent_limits.h"
#include "pipeline/filtered_view.h"
#include "pipeline/ground_view.h"
#include "process.h"
#include "tiled_labels.h"
#include "tiles.h"

namespace pcl_bv::detail {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// The points to be clustered, and the stages that have dropped others.
struct RemainingPoints {
  FilteredView filtered;
  GroundView ground;
  PointView points;
};

RemainingPoints remaining_points(const PointView& cloud, const PipelineConfig& config) {
  RemainingPoints remaining;
  remaining.filtered = filter_points(cloud, config.filter, config.execution());
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
        table_(options.pipeline),
        store_(store_options(options, scalar)) {}

  // Adds the objects of all classes. They have the order of the objects of a cloud in memory.
  void add_classes(const ClassifiedPoints& cloud, const RemainingPoints& remaining) {
    const ParallelPolicy& policy = options_.pipeline.execution().parallel;
    std::size_t valid = 0;
    for (const auto& [value, count] : count_classes(cloud, policy)) {
      valid += count;
      const auto own = std::find_if(table_.class_options().begin(), table_.class_options().end(),
                                    [value = value](const ClassOptions& one) { return one.value == value; });
      const bool has_own = own != table_.class_options().end();
      if (has_own && own->drop) {
        report_.counts.dropped_class += count;
      } else {
        add_clusters(ClassPoints(cloud, value).view(), has_own ? own->clusters : table_.default_options(),
                     value);
      }
    }
    set_dropped_counts(remaining, valid, report_);
    sort();
  }

  // Adds the objects of points without classes.
  void add_all(const RemainingPoints& remaining) {
    const std::size_t invalid = add_clusters(remaining.points, table_.default_options(), std::nullopt);
    set_dropped_counts(remaining, remaining.points.count - invalid, report_);
  }

  double fit_seconds() const { return fit_seconds_; }

  void write_report() {
    report_.clusters.clear();
    for (Object& object : objects_) {
      object.entry.id = report_.clusters.size();
      if (options_.labels) {
        std::vector<std::uint32_t>& id_of = ids_[object.clusters];
        id_of.resize(object.clusters->size(), kLabelNone);
        id_of[object.cluster] = static_cast<std::uint32_t>(object.entry.id);
      }
      report_.clusters.push_back(std::move(object.entry));
    }
  }

  // Returns the labels of points as labels_of() does.
  std::vector<std::uint32_t> labels(const RemainingPoints& remaining, std::size_t first,
                                    std::size_t count) const {
    std::vector<std::uint32_t> labels(count, kLabelNone);
    for (const auto& clusters : found_) {
      if (!ids_.contains(clusters.get())) continue;  // no object
      const std::vector<std::uint32_t>& id_of = ids_.at(clusters.get());
      const std::vector<std::uint32_t> found = clusters->labels(first, count);
      for (std::size_t i = 0; i < count; ++i)
        if (found[i] != StoredClusters::kNoCluster) labels[i] = id_of[found[i]];
    }
    if (remaining.ground.owner == nullptr) return labels;
    const LoadedPoints before(remaining.filtered.points, first, count), after(remaining.points, first, count);
    for (std::size_t i = 0; i < count; ++i) {
      const bool ground = is_valid(load_point(before.view(), i)) && !is_valid(load_point(after.view(), i));
      if (ground) labels[i] = kLabelGround;
    }
    return labels;
  }

  // Writes the points of each object to a file.
  Status write_points(const std::filesystem::path& folder) const {
    return write_objects(
        folder, objects_.size(), options_.pipeline.execution().parallel, [&](std::size_t id) {
          write_object(folder, id, objects_[id].clusters->points(objects_[id].cluster).view());
        });
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
    found_.push_back(std::make_unique<StoredClusters>(points, options, store, options_.pipeline.execution()));
    const StoredClusters& clusters = *found_.back();
    Counts& counts = report_.counts;
    counts.small += clusters.counts().small;
    counts.large += clusters.counts().large;
    counts.noise += clusters.counts().noise;
    const Clock::time_point begin = Clock::now();
    std::vector<Object> objects = fitter.fit(clusters);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      const ExtentVerdict verdict = objects[i].verdict;
      if (verdict == ExtentVerdict::small) counts.small += clusters.point_count(i);
      if (verdict == ExtentVerdict::large) counts.large += clusters.point_count(i);
      if (verdict == ExtentVerdict::keep) objects_.push_back(std::move(objects[i]));
    }
    fit_seconds_ += seconds_since(begin);
    const std::size_t invalid = clusters.counts().nonfinite;
    if (!options_.objects && !options_.labels) found_.pop_back();
    return invalid;
  }

  // Sorts the objects of several classes: the largest first, then by their first point.
  void sort() {
    std::sort(objects_.begin(), objects_.end(), [](const Object& a, const Object& b) {
      return a.entry.points != b.entry.points ? a.entry.points > b.entry.points
                                              : a.first_number < b.first_number;
    });
  }

  const Options& options_;
  Report& report_;
  ClassTable table_;
  StoredClusterOptions store_;
  std::vector<std::unique_ptr<StoredClusters>> found_;  // of each class, if points are to be written
  std::vector<Object> objects_;
  // For each cluster, the id of its object, or kLabelNone. If labels are to be written.
  std::unordered_map<const StoredClusters*, std::vector<std::uint32_t>> ids_;
  double fit_seconds_ = 0;
};

// Finds the clusters of a cloud, whose points may be in files, fits the volumes and writes the points of
// objects.
Status add_objects_of(const PointView& cloud, const Job& job, const Options& options, Report& report) {
  const Clock::time_point begin = Clock::now();
  const PipelineConfig& config = options.pipeline;
  report.points = cloud.count;
  report.counts = Counts();
  const RemainingPoints remaining = remaining_points(cloud, config);
  TiledObjects objects(options, cloud.scalar, report);
  if (const auto& field = config.cluster.class_field) {
    objects.add_classes({remaining.points, *job.tiles, field->name}, remaining);
  } else {
    objects.add_all(remaining);
  }
  objects.write_report();
  const double all = seconds_since(begin);
  if (options.timings) report.seconds = {0, all - objects.fit_seconds(), objects.fit_seconds()};
  const Status written = job.objects ? objects.write_points(*job.objects) : Status::done;
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
  const std::string ground = ground_warning(counted, option_names(false));
  if (!ground.empty()) report_problem(job.input + ": " + ground);
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
