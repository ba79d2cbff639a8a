// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/frame_result.h"

#include <algorithm>
#include <utility>

#include "filter.h"
#include "ground.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/points/select_points.h"
#include "pcl_bv/report/picture.h"
#include "pcl_bv/segmentation/up.h"
#include "pipeline/config/settings.h"
#include "pipeline/deskew/point_times.h"

namespace pcl_bv {
using namespace detail;

PointView FrameResult::points_after_filter(const PointView& cloud) const {
  if (counts.range + counts.inside == 0) return cloud;
  if (!filtered) return select_points(cloud, passed_filter);
  PointView view = view_of(*filtered, points, cloud.scalar);
  view.first = cloud.first;
  return view;
}

PointView FrameResult::points_of(std::size_t cluster, const PointView& cloud) const {
  const std::size_t size = clusters.list_size(cluster);
  if (size == 0) return cloud.slice(0, 0);
  if (clusters.indices.empty()) return points_after_filter(cloud);
  return select_points(cloud, clusters.list(cluster), size);
}

std::vector<std::uint32_t> labels_of(const Frame& frame, const FrameResult& result) {
  const PointView& cloud = frame.points;
  std::size_t size = cloud.first + cloud.count;
  if (const std::int32_t* numbers = cloud.indices; numbers != nullptr && cloud.count > 0)
    size = static_cast<std::size_t>(*std::max_element(numbers, numbers + cloud.count)) + 1;
  std::vector<std::uint32_t> label(size, kLabelNone);
  for (const std::int32_t i : result.ground.ground)
    label[static_cast<std::size_t>(i)] = kLabelGround;
  const Clusters& clusters = result.clusters;
  for (std::size_t id = 0; id < clusters.size(); ++id) {
    for (std::size_t i = clusters.offsets[id];
         i < std::min(clusters.offsets[id + 1], clusters.indices.size()); ++i)
      label[static_cast<std::size_t>(clusters.indices[i])] = static_cast<std::uint32_t>(id);
  }
  if (!clusters.indices.empty() || clusters.size() == 0) return label;
  const PointView all = result.points_of(0, cloud);  // the cluster has no index list
  for (std::size_t chunk = 0; chunk < chunk_count(all.count); ++chunk) {
    const LoadedPoints loaded = load_chunk(all, chunk);
    const PointView& part = loaded.view();
    for (std::size_t i = 0; i < part.count; ++i) {
      if (is_valid(load_point(part, i))) label[part.index(i)] = 0;
    }
  }
  return label;
}

std::string ground_warning(const FrameResult& result, const SettingName& name, const std::string& better_up) {
  const GroundConfig& ground = result.config->ground;
  const Counts& counts = result.counts;
  const std::size_t candidates = result.points - counts.nonfinite - counts.range - counts.inside;
  if (ground.method == GroundMethod::none || candidates < kFewPoints) return {};
  if (counts.ground > 0 && counts.ground < candidates) return {};
  const std::string advice =
                        " (up is " + format_up(ground.up) + "): try " + name("ground.up") + better_up + ", ",
                    none = ", or " + name("ground.method") + " none";
  if (counts.ground > 0)
    return "all points were classified as ground" + advice + name("ground.distance") + none;
  return "no ground found" + advice + name("ground.sensor_height") + ", " + name("ground.max_slope_degrees") +
         none;
}

std::string range_warning(const FrameResult& result, const std::string& from) {
  const FilterConfig& filter = result.config->filter;
  const std::size_t finite = result.points - result.counts.nonfinite, out = result.counts.range;
  constexpr std::size_t few = 100;
  if (finite < few || 2 * out <= finite) return {};
  const std::string or_in_box = filter.own_box_min ? " or in the box of the own vehicle" : "";
  return std::to_string(out) + " of " + std::to_string(finite) + " points are outside the range of " +
         to_text(filter.range_min) + " to " + to_text(filter.range_max) + " m from the origin (" + from +
         ")" + or_in_box;
}

std::string track_warning(const FrameResult& result) {
  switch (result.track_time) {
    case TrackTime::recorded:
      return "frame stamps do not advance: tracking uses the recording times";
    case TrackTime::none:
      return "frame stamps do not advance: tracks are expected at their last positions";
    case TrackTime::gap:
      return "frames are more than 1 s apart: tracks are expected at their last positions";
    case TrackTime::restarted:
      return "frame stamps went back by more than 1 s: tracks begin anew";
    default:
      return {};
  }
}

namespace {

// Returns why the points were not moved to the stamp; an empty text if they were, or should not be.
std::string reason_not_moved(const FrameResult& result) {
  switch (result.deskew.outcome) {
    case DeskewOutcome::no_times:
      return "they have no times, or an index list";
    case DeskewOutcome::no_motion:
      // The first frames of a stream have no motion.
      return result.header.number > 2
                 ? "the motion of the sensor is unknown: it needs poses or tracks of the "
                   "frames before, and stamps that advance by at most 1 s"
                 : "";
    case DeskewOutcome::bad_times:
      return result.deskew.times.problem == DeskewTimes::Problem::no_time
                 ? "no point has a time"
                 : "their times do not span 1 ms to 1 s in s, ms, us or ns";
    case DeskewOutcome::too_fast:
      return "the sensor rotates by more than 28 degrees within a sweep";
    default:
      return "";
  }
}

}  // namespace

std::string deskew_warning(const FrameResult& result) {
  const DeskewTimes& times = result.deskew.times;
  if (!result.deskew.moved()) {
    const std::string reason = result.config->deskew == Deskew::on ? reason_not_moved(result) : "";
    return reason.empty() ? "" : "points cannot be moved to the stamp: " + reason;
  }
  return detail::times_warning(times);
}

namespace {

void fill_entry(const FrameResult& result, std::size_t id, ClusterEntry& entry) {
  entry.id = id;
  entry.points = result.clusters.list_size(id);
  if (!result.class_of.empty()) entry.class_value = result.class_of[id];
  if (!result.refinements.empty()) entry.refinement = result.refinements[id];
  if (!result.tracks.empty()) entry.track = result.tracks[id];
  entry.volumes.resize(result.methods.size());
  std::size_t n = 0;
  for (std::size_t m = 0; m < result.methods.size(); ++m) {
    if (!result.is_requested(id, m)) continue;
    VolumeEntry& volume = entry.volumes[n++];
    volume.method = result.methods[m]->name;
    volume.volume = result.volume(id, m);
    volume.failed = result.results[id * result.methods.size() + m].reason;
  }
  entry.volumes.resize(n);
}

}  // namespace

std::vector<ClusterEntry> cluster_entries(const FrameResult& result) {
  std::vector<ClusterEntry> entries(result.clusters.size());
  for (std::size_t id = 0; id < entries.size(); ++id)
    fill_entry(result, id, entries[id]);
  return entries;
}

ClusterSource cluster_source(const FrameResult& result) {
  return {result.clusters.size(),
          [&result, entry = ClusterEntry()](std::size_t id) mutable -> const ClusterEntry& {
            fill_entry(result, id, entry);
            return entry;
          }};
}

FrameReport report_of_lost(const Frame& frame, const std::string& reason) {
  FrameReport report;
  report.seq = frame.header.seq;
  report.stamp_ns = frame.header.stamp_ns;
  report.frame_id = frame.header.frame_id;
  report.file = frame.file;
  report.error = reason;
  return report;
}

FrameReport report_of(const Frame& frame, const FrameResult& result) {
  FrameReport report = report_without_clusters(frame, result);
  report.clusters = cluster_entries(result);
  return report;
}

FrameReport report_without_clusters(const Frame& frame, const FrameResult& result) {
  FrameReport report = report_of_lost(frame, "");
  report.error.reset();
  report.points = result.points;
  report.counts = result.counts;
  for (const SensorPart& sensor : frame.sensors)
    report.sensors.push_back({sensor.name, sensor.count, sensor.stamp_ns});
  if (result.deskew.moved() && result.deskew.times.unit != nullptr)
    report.deskew = result.deskew.outcome == DeskewOutcome::by_poses ? "poses" : "tracks";
  const StageTimes& ms = result.ms;
  report.ms = {{"decode", ms.decode}, {"filter", ms.filter}, {"ground", ms.ground}, {"cluster", ms.cluster},
               {"fit", ms.fit},       {"track", ms.track},   {"total", ms.total}};
  return report;
}

Picture picture_of(const Frame& frame, const FrameResult& result, const std::vector<std::uint32_t>& labels) {
  const bool clusters = result.config->cluster.tolerance > 0;
  const bool ground = !clusters && result.config->ground.method != GroundMethod::none;
  Picture picture;
  picture.up = result.config->ground.up;
  for (const Method* method : result.methods)
    picture.methods.emplace_back(method->name);
  const PointView& cloud = result.cloud_of(frame);
  picture.points = ground ? select_points(cloud, result.ground.rest) : result.points_after_filter(cloud);
  if (clusters) picture.labels = labels.data();
  for (std::size_t id = 0; id < result.clusters.size(); ++id) {
    std::string label = clusters ? std::to_string(id) : "";  // shown at the first volume that is not empty
    for (std::uint32_t m = 0; m < result.methods.size(); ++m) {
      const AnyVolume& volume = result.volume(id, m);
      const std::uint32_t colour = clusters ? static_cast<std::uint32_t>(id) : m;
      picture.volumes.push_back({volume, colour, empty(volume) ? "" : std::exchange(label, {}), m});
    }
  }
  return picture;
}

}  // namespace pcl_bv
