// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The result of one frame, the warnings about it, and percentiles of its times.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/report/report.h"
#include "pcl_bv/segmentation/clusters.h"
#include "pcl_bv/segmentation/ground.h"

namespace [[gnu::visibility("default")]] pcl_bv {

namespace detail {
struct Picture;
}

/// Percentiles of durations from 1 us to 1000 s, accurate to 1 %. Durations are counted in bins. The upper
/// limit of a bin is 1 % above that of the bin before. Never allocates.
class LatencyHistogram {
 public:
  /// Adds a duration in milliseconds. Durations below 1 us go into the first bin and durations above 1000 s
  /// into the last bin, but max() is exact. Negative durations and NaN are treated as 0.
  void add(double milliseconds);

  std::uint64_t count() const { return count_; }
  double max() const { return max_; }  ///< Longest duration, milliseconds; 0 if empty.

  /// Returns the duration, milliseconds, that a `share` (0 to 1) of all durations does not exceed. It is
  /// computed by the nearest-rank method and is at most 1 % above the exact value. Returns 0 if the histogram
  /// is empty.
  double percentile(double share) const;

 private:
  static constexpr std::size_t kBinCount = 2084;  // ln(1e9) / ln(1.01) + 1
  std::array<std::uint32_t, kBinCount> bins_{};
  std::uint64_t count_ = 0;
  double max_ = 0;
};

/// Wall-clock milliseconds of each stage. `total` covers all stages except decode.
struct StageTimes {
  double decode = 0, filter = 0, ground = 0, cluster = 0, fit = 0, track = 0, total = 0;
};

/// Source of the time step from the frame before to a tracked frame.
enum class TrackTime : std::uint8_t {
  /// The stamp advanced. The step is the difference of the stamps, except after a frame whose TrackTime is
  /// `recorded`. The stamp of that frame is not trusted. Therefore the step is then the difference of
  /// Frame::recorded_ns, if that advanced.
  stamps,
  recorded,  ///< The stamp did not advance. Frame::recorded_ns gives the step.
  none,  ///< Neither the stamp nor Frame::recorded_ns advanced. Tracks are expected at their last positions.
  gap,   ///< The step is longer than one second. Tracks are expected at their last positions.
  /// The stamp went back by more than one second: the source has begun again. All tracks were deleted.
  restarted
};

/// The unit of the times of points.
struct TimeUnit {
  const char* name;
  double seconds;
};

/// What was found in Frame::times.
struct DeskewTimes {
  enum class Problem : std::uint8_t {
    none,
    no_time,  ///< No point with a return has a finite time.
    no_sweep  ///< In no unit (s, ms, us, ns) do the times span 1 ms to 1 s.
  };
  /// What the times are relative to.
  enum class Origin : std::uint8_t {
    stamp,       ///< To the stamp of the frame.
    absolute,    ///< To the origin of the stamps, such as 1970.
    first_point  ///< To something else. The first point is assumed to have the time of the stamp.
  };
  Problem problem = Problem::none;
  Origin origin = Origin::stamp;
  /// Null if no point has a time within its sweep: the clouds of a rig's sensors without times are moved as a
  /// whole to the frame's stamp.
  const TimeUnit* unit = nullptr;
  double first = 0, last = 0;   ///< Smallest and largest time, seconds after the stamp.
  double clock_difference = 0;  ///< Times minus stamp, seconds, if `origin` is first_point.
  std::size_t outside = 0;      ///< Points with a return but without a time of the sweep. They are not moved.
};

/// Result of deskewing (PipelineConfig::deskew).
enum class DeskewOutcome : std::uint8_t {
  off,        ///< Not requested, or ground removal and clustering are both off.
  no_times,   ///< Frame::times is not set, Frame::seconds are all 0, or Frame::points has an index list.
  bad_times,  ///< See DeskewTimes::problem.
  no_motion,  ///< The motion of the sensor is unknown, or faster than 100 m/s.
  too_fast,   ///< The sensor turned by more than half a radian within the sweep.
  by_poses,   ///< The points were moved. The motion comes from Frame::pose of this frame and the one before.
  by_tracks   ///< The points were moved. The motion is that of the tracker between the two frames before.
};

/// The points of a frame, moved to where the sensor would have measured them at the stamp.
struct DeskewResult {
  DeskewOutcome outcome = DeskewOutcome::off;
  DeskewTimes times;
  PointView points;  ///< All points of the frame, until the pipeline's next process(). Empty unless moved.

  bool moved() const { return outcome == DeskewOutcome::by_poses || outcome == DeskewOutcome::by_tracks; }
};

/// Everything found in one frame. A reused object keeps its capacity. Indices are those of the frame's cloud.
struct FrameResult {
  FrameHeader header;
  /// The configuration with which the frame was processed; never null.
  std::shared_ptr<const PipelineConfig> config = std::make_shared<PipelineConfig>();
  std::size_t points = 0;  ///< Number of points of the cloud, valid or not.
  Counts counts;           ///< Number of points in no cluster, by reason.
  /// Indices of the points that passed the filter; see points_after_filter().
  std::vector<std::int32_t> passed_filter;
  GroundSplit ground;  ///< Ground and other points. `found` is false without ground removal.
  /// Sensor position, which is the centre of the ground zones. The first case that applies decides:
  /// 1. Frame::recorded_origin, if no enabled setting depends on the position or the points are not in
  /// memory;
  /// 2. ground.sensor, if given;
  /// 3. Frame::sensor, if the points lie around it;
  /// 4. Frame::recorded_origin, if the points lie around it;
  /// 5. the densest part of the cloud (find_sensor()).
  SensorPosition sensor;
  /// Whether the points lie around Frame::recorded_origin, from which filter.range_max and
  /// cluster.tolerance_per_metre are measured. Always true if neither setting is used and the ground method
  /// is not zones. Also always true for points that are not in memory.
  bool around_origin = true;
  /// The points that all later stages used, if they were moved to the stamp. The filter comes before.
  DeskewResult deskew;
  /// The clusters, largest first. Without clustering, all remaining points are one cluster, which may have no
  /// index list. Therefore read the points of clusters by points_of().
  Clusters clusters;
  std::vector<std::int64_t> class_of;   ///< Class of each cluster; empty without cluster.class_field.
  std::vector<Refinement> refinements;  ///< For each cluster; empty without cluster.refine.
  /// The filtered points, used instead of `passed_filter` for large clouds without index lists.
  std::shared_ptr<const PointSource> filtered;

  TrackTime track_time = TrackTime::stamps;  ///< Meaningful only with tracking.
  /// Track of each cluster; nullopt until the track has its id. Empty without tracking.
  std::vector<std::optional<TrackEntry>> tracks;
  /// Ids of all tracks that have not ended, ascending, also of those without a cluster in this frame. Empty
  /// without tracking.
  std::vector<std::uint32_t> active_tracks;

  /// The requested methods of all classes, in the order of PipelineConfig::methods().
  std::vector<const Method*> methods;
  std::vector<AnyVolume> volumes;  ///< For each cluster, one volume per entry of `methods`.
  /// For each volume: whether the cluster's class requests it (0 or 1). Volumes that are not requested are
  /// empty. If `requested` is empty, all volumes are requested.
  std::vector<std::uint8_t> requested;
  /// For each volume: the result of its fit. A failed fit leaves the volume empty.
  std::vector<EstimationResult> results;
  StageTimes ms;
  /// Warnings about this frame (FrameWarnings), one line each. Each kind of warning is in the result of one
  /// frame only, until the configuration changes. Usually empty.
  std::vector<std::string> warnings;

  /// Returns the track of a cluster, or null if tracking is off or the cluster has no confirmed track.
  const TrackEntry* track_of(std::size_t cluster) const {
    return tracks.empty() || !tracks[cluster] ? nullptr : &*tracks[cluster];
  }

  /// Returns the volume of a cluster by `methods[method]`.
  const AnyVolume& volume(std::size_t cluster, std::size_t method) const {
    return volumes[cluster * methods.size() + method];
  }
  /// Returns whether the cluster's class requests `methods[method]`.
  bool is_requested(std::size_t cluster, std::size_t method) const {
    return requested.empty() || requested[cluster * methods.size() + method] != 0;
  }

  /// Returns all points of the frame as the volumes enclose them: moved to the stamp or as measured.
  const PointView& cloud_of(const Frame& frame) const {
    return deskew.moved() ? deskew.points : frame.points;
  }
  /// Return the points that passed the filter, and the points of a cluster. Both views may contain invalid
  /// points. `cloud` must be cloud_of() of the frame. The views refer to `cloud` and to the lists of this
  /// object.
  PointView points_after_filter(const PointView& cloud) const;
  PointView points_of(std::size_t cluster, const PointView& cloud) const;
};

/// Returns for each point of the frame's cloud the number of its cluster, kLabelGround or kLabelNone. If
/// frame.points has an index list, there is a label for each index from 0 to the largest one in the list.
/// `result` must be the result of `frame`.
std::vector<std::uint32_t> labels_of(const Frame& frame, const FrameResult& result);

/// Returns a warning if ground removal found no ground, or only ground, among at least 100 points. Otherwise
/// returns an empty text. The warning names the settings to try. `better_up` is inserted after the name of
/// ground.up.
std::string ground_warning(const FrameResult& result, const SettingName& name = key_of_setting,
                           const std::string& better_up = "");

/// Returns a warning if more than half of at least 100 finite points were out of range or in the box of the
/// own vehicle (Counts::range). Otherwise returns an empty text. `from` tells where the range was set
/// ("--preset table").
std::string range_warning(const FrameResult& result, const std::string& from);

/// Returns a warning if the frame is tracked and its stamp does not advance. Otherwise returns an empty text.
/// The warning tells how tracking then determines the time.
std::string track_warning(const FrameResult& result);

/// Returns a line about PipelineConfig::deskew if it was not possible although required, if points have no
/// time of the sweep, or if the clocks of the points and of the stamps differ. Otherwise returns an empty
/// text.
std::string deskew_warning(const FrameResult& result);

/// Returns the report entries of all clusters.
std::vector<ClusterEntry> cluster_entries(const FrameResult& result);

/// Returns a source of the entries of cluster_entries(). The source makes one entry at a time, so that a
/// million entries are never in memory together. The source refers to `result`.
ClusterSource cluster_source(const FrameResult& result);

/// Returns the report of a frame with its clusters.
FrameReport report_of(const Frame& frame, const FrameResult& result);
/// Returns the report of a frame without its clusters.
FrameReport report_without_clusters(const Frame& frame, const FrameResult& result);
/// Returns the report of a lost frame; `reason` tells why it was lost.
FrameReport report_of_lost(const Frame& frame, const std::string& reason);

/// Returns a picture of the frame and its volumes, with ground.up upwards. With clustering, the picture shows
/// the id of each cluster and the points that passed the filter. `labels` (from labels_of()) determines the
/// colours of the points. Without clustering, the picture shows the points that passed the filter and are not
/// ground. The picture refers to `frame`, `result` and `labels`.
detail::Picture picture_of(const Frame& frame, const FrameResult& result,
                           const std::vector<std::uint32_t>& labels);

/// Detects causes of results that a user should not trust:
/// - no ground, little ground or only ground;
/// - a cloud that does not surround its sensor or is upside down;
/// - many points far away;
/// - a sensor height that fits no plane;
/// - stamps of tracked frames that do not advance, go back, or advance by more than one second;
/// - points that could not be moved to the stamp (deskew_warning()). The warning names the sensors of a rig
///   whose points have no times of a sweep.
class FrameWarnings {
 public:
  /// The warnings name settings by `name`.
  explicit FrameWarnings(SettingName name = key_of_setting) : name_(std::move(name)) {}

  /// Returns the warnings about a result, one line each. Each kind of warning is returned once per
  /// configuration. `frame` is the frame of `result`. If ground was removed, the points of `frame` must be in
  /// memory.
  ///
  /// O(1), except for the search for another up direction, which takes milliseconds. Per configuration, there
  /// is at most one search for a frame without ground and one for a frame with little ground.
  std::vector<std::string> take(const Frame& frame, const FrameResult& result);

 private:
  SettingName name_;
  std::shared_ptr<const PipelineConfig> config_;
  std::uint32_t returned_ = 0;  // kinds already returned, one bit each
  bool searched_ = false;       // whether little ground has led to a search for another up direction
};

}  // namespace
