// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What was found in one frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/report/frame_report.h"
#include "pcl_bv/report/picture.h"
#include "pcl_bv/report/report.h"
#include "pcl_bv/segmentation/euclidean_clusters.h"
#include "pcl_bv/segmentation/ground_plane.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Wall-clock milliseconds of each stage; `total` is from the cloud in memory to the volumes, without decode.
struct StageTimes {
  double decode = 0, filter = 0, ground = 0, cluster = 0, fit = 0, track = 0, total = 0;
};

/// Where the time between a tracked frame and the one before comes from.
enum class TrackTime : std::uint8_t {
  stamps,    ///< They advance.
  recorded,  ///< This stamp or the previous one did not advance; recorded_ns did.
  none       ///< Neither advanced: tracks stay where they were.
};

/// Reuse keeps the capacity. Indices are those of the frame's cloud.
struct FrameResult {
  FrameHeader header;
  /// What was asked for; never null.
  std::shared_ptr<const PipelineConfig> config = std::make_shared<PipelineConfig>();
  std::size_t points = 0;          ///< All points of the cloud, good or bad.
  Counts counts;                   ///< Points that are in no cluster, by reason.
  std::vector<std::int32_t> kept;  ///< What passed the filter, if that dropped points: see kept_points().
  GroundSplit ground;              ///< The ground's points; not found if no ground was asked for.
  /// Where zones begin: ground.sensor, otherwise Frame::sensor or the origin if the points lie around it,
  /// otherwise where they are densest (find_sensor()). The origin if nothing depends on it.
  SensorPlace sensor;
  /// Whether the points lie around the origin, from which filter.range_max and cluster.tolerance_per_metre
  /// count; true if neither is set and ground is not found by zones, and for points that are not in memory.
  bool around_origin = true;
  /// Largest first; if none were asked for, all points left are one. That one has no index list if points
  /// did not have to be told apart, as without ground: see points_of().
  Clusters clusters;
  std::vector<std::int64_t> class_of;  ///< Of each cluster, if they are told apart by class; else empty.
  std::shared_ptr<const PointSource> filtered;  ///< Instead of `kept`, for big clouds without index lists.

  TrackTime track_time = TrackTime::stamps;  ///< Only with tracking.
  /// For each cluster its track, none until the track is born; empty without tracking.
  std::vector<std::optional<TrackEntry>> tracks;

  /// Of the volumes of each cluster, in the order asked for; where classes have volumes of their own, of all.
  std::vector<const Method*> methods;
  std::vector<AnyVolume> volumes;  ///< Cluster by cluster, in each as `methods` says.
  std::vector<std::uint8_t>
      wanted;  ///< Of `volumes`: 0 where the class has others, and it is empty; if empty, all are.
  std::vector<EstimationResult>
      results;  ///< What the fits of `volumes` said; those that failed left them empty.
  StageTimes ms;

  const AnyVolume& volume(std::size_t cluster, std::size_t method) const {
    return volumes[cluster * methods.size() + method];
  }
  bool has(std::size_t cluster, std::size_t method) const {
    return wanted.empty() || wanted[cluster * methods.size() + method] != 0;
  }

  /// What passed the filter, and what is in a cluster, as views of `cloud`, the frame's points, and of the
  /// lists above. They may hold points that are not valid.
  PointView kept_points(const PointView& cloud) const;
  PointView points_of(std::size_t cluster, const PointView& cloud) const;
};

/// For each point of the frame's cloud (where `points` has an index list: up to the greatest number in it)
/// the number of its cluster, label_ground, or label_none. `result` must be that of the frame.
std::vector<std::uint32_t> labels_of(const Frame& frame, const FrameResult& result);

/// If ground was asked for and there is none in a hundred points or more, or nothing else: that, and which
/// settings (by their keys) to try; else nothing.
std::string ground_remark(const FrameResult& result);

/// If the range (filter.range_min to filter.range_max) drops more than half of a hundred finite points or
/// more: that, and what the range is; `from` says where it comes from ("--preset table"). Else nothing.
std::string range_remark(const FrameResult& result, const std::string& from);

/// If the frame is tracked and its stamp does not advance: that, and what tracks use instead; else nothing.
std::string track_remark(const FrameResult& result);

/// The clusters as they are reported.
std::vector<ClusterEntry> entries_of(const FrameResult& result);

/// The same one by one, so that a million need no memory. Views the result.
ClusterSource cluster_source(const FrameResult& result);

/// The frame as it is reported, with and without its clusters, and one that was lost, with the reason.
FrameReport report_of(const Frame& frame, const FrameResult& result);
FrameReport report_without_clusters(const Frame& frame, const FrameResult& result);
FrameReport report_of_lost(const Frame& frame, const std::string& reason);

/// The frame and what was found in it, up as the configuration says: with clusters the points that passed
/// the filter in the colours of `labels`, as labels_of() gives them, and each cluster's id; else those that
/// are no ground. Views the frame, the result and the labels.
Picture picture_of(const Frame& frame, const FrameResult& result, const std::vector<std::uint32_t>& labels);

}  // namespace pcl_bv
