// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The result of one input as plain data, as JSON for programs and as a table for people.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/segmentation/cloud_statistics.h"
#include "pcl_bv/segmentation/clusters.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Labels of points that belong to no cluster. kLabelGround is for ground, kLabelNone for all others.
inline constexpr std::uint32_t kLabelGround = 4294967294;
inline constexpr std::uint32_t kLabelNone = 4294967295;

/// A fitted volume of a cluster.
struct VolumeEntry {
  std::string method;  ///< Canonical name of the method, such as "dop26"; never an alias.
  AnyVolume volume;
  /// Number of points outside the volume, counted by verify(). Not set if the volume was not verified.
  std::optional<std::size_t> outside;
  std::string failed{};  ///< Reason why the fit failed and `volume` is empty. Empty if the fit succeeded.
};

/// A tracked object.
struct TrackEntry {
  std::uint32_t id = 0;  ///< Unique. It is never reused for another object.
  std::size_t age = 0;   ///< Number of frames from the first detection until now, both frames included.
  /// Velocity in units of the points per second. It is in the fixed frame if the sensor's pose is known.
  /// Otherwise it is relative to the sensor, in the sensor's frame.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  /// Whether the object moves relative to the ground or, if the sensor's motion is unknown, relative to the
  /// sensor.
  bool moving = false;
  /// x, y, z of the centre, and the heading (yaw) in radians, in the frame of `velocity`. The yaw is the
  /// direction of motion over ground. Before the object has moved, the yaw is the direction of the longer
  /// side.
  std::array<double, 4> pose{};
  /// Covariance of x, y, z, yaw, vx, vy. It is the upper triangle of a positive definite matrix, row by row.
  std::array<double, 21> covariance{};

  friend bool operator==(const TrackEntry& a, const TrackEntry& b) {
    return a.id == b.id && a.age == b.age && a.velocity == b.velocity && a.moving == b.moving &&
           a.pose == b.pose && a.covariance == b.covariance;
  }
};

/// A cluster with its volumes.
struct ClusterEntry {
  std::size_t id = 0;
  std::size_t points = 0;  ///< Number of valid points.
  std::vector<VolumeEntry> volumes;
  std::optional<std::int64_t> class_value{};  ///< Class of the points, if points are segmented by class.
  bool incomplete = false;  ///< Whether it may lack points, because an input near it is damaged.
  Refinement refinement = Refinement::none;
  std::optional<TrackEntry> track{};  ///< Track, if tracking is on and the track is confirmed.
};

/// Wall-clock time of each stage in seconds.
struct Seconds {
  double read = 0;
  double segment = 0;
  double fit = 0;
};

/// Statistics of an input's cloud. Organised clouds have height > 1.
struct CloudInfo : CloudStatistics {
  std::size_t width = 0;
  std::size_t height = 1;
  std::vector<PointField> fields;
};

/// An input of a merged cloud that could not be read. Objects near its points may lack points.
struct LeftOutInput {
  std::string file;   ///< Path as the user named it. Writers replace invalid UTF-8.
  std::string error;  ///< Why it could not be read.
};

/// The result of one input. If `error` is set, the input failed, and only `file` and `error` are valid.
struct Report {
  std::string file;                       ///< Path as the user named it. Writers replace invalid UTF-8.
  std::optional<std::size_t> parts;       ///< Number of inputs, if several inputs are merged into one cloud.
  std::vector<LeftOutInput> left_out;     ///< Inputs of a merged cloud that could not be read.
  std::size_t points = 0;                 ///< Number of all points of the input, valid or not.
  std::optional<Eigen::Vector3d> origin;  ///< Vector that was subtracted from all coordinates, if any.
  Counts counts;                          ///< Numbers of dropped points by reason.
  std::vector<ClusterEntry> clusters;
  std::optional<CloudInfo> info;
  std::optional<Seconds> seconds;
  std::optional<std::string> error;  ///< Reason of the failure, if any.
};

/// A sequence of clusters that are created on demand, because a vector of a million clusters takes 500 MB.
struct ClusterSource {
  std::size_t count = 0;
  std::function<const ClusterEntry&(std::size_t)> at;  ///< Returns a cluster, valid until the next call.
};

/// Returns a source with the clusters of a vector, which must outlive the source.
ClusterSource vector_source(const std::vector<ClusterEntry>& clusters);

/// Receives a text piece by piece. A sink may modify or move from `piece`, whose content is not used
/// afterwards.
using TextSink = std::function<void(std::string& piece)>;

/// Returns the report as one JSON object on one line, without a line end.
///
/// Every number of a volume has the fewest digits that read back as exactly the same double. A volume that is
/// read back therefore contains the same points. There is no null, NaN or -0. An empty volume has
/// `"empty":true` instead of the numbers of its shape. A volume whose fit failed has `"failed"` with the
/// reason instead. Throws std::domain_error if a number is not finite, which does not occur in fitted
/// volumes.
std::string report_json(const Report& report);

/// Writes the text of report_json() to `take` in pieces of about a megabyte. The clusters are those of
/// `clusters`; report.clusters is ignored.
void write_report_json(const Report& report, const ClusterSource& clusters, const TextSink& take);

/// Returns the report as text: a line about the input, then a table of at most 120 columns. The table has a
/// row for each volume with its centre, size and volume in the unit of the points. Upright boxes have length,
/// width, height and the yaw (Obb::yaw()) in radians. The numbers are rounded; report_json() has the exact
/// values. Returns an empty text for a failed report.
std::string report_text(const Report& report);
/// Writes the text of report_text() to `take` in pieces. The clusters are those of `clusters`;
/// report.clusters is ignored.
void write_report_text(const Report& report, const ClusterSource& clusters, const TextSink& take);

/// The share of a sensor in a merged cloud.
struct SensorEntry {
  std::string name;
  std::size_t points = 0;     ///< 0 if the sensor sent no cloud for this frame.
  std::int64_t stamp_ns = 0;  ///< Stamp of its cloud, nanoseconds; left out of the JSON without points.
};

/// The result of one frame. If `error` is set, the frame was not processed, and only seq, stamp_ns, frame_id,
/// file and error are valid.
struct FrameReport {
  std::uint64_t seq = 0;      ///< Number of the frame in the stream.
  std::int64_t stamp_ns = 0;  ///< Time stamp, nanoseconds.
  std::string frame_id;       ///< Name of the coordinate frame.
  std::string file;           ///< Path of the cloud's file; left out of the JSON if empty.
  std::size_t points = 0;     ///< Number of all points, valid or not.
  Counts counts;              ///< Numbers of dropped points by reason.
  /// "poses" or "tracks" if the points were moved to the stamp by this motion; left out of the JSON if empty.
  std::string deskew{};
  std::vector<SensorEntry> sensors{};  ///< Of a merged cloud; left out of the JSON if empty.
  std::vector<ClusterEntry> clusters;
  std::vector<std::pair<std::string, double>> ms;  ///< Milliseconds of each stage, in the stages' order.
  std::optional<std::string> error;                ///< Reason of the failure, if any.
};

/// Returns the frame as one JSON object on one line, without a line end. Numbers are as in report_json().
/// `track` is null for a cluster without a track.
std::string frame_json(const FrameReport& report);

/// Like frame_json(report), but the clusters are those of `clusters`, and report.clusters is ignored.
std::string frame_json(const FrameReport& report, const ClusterSource& clusters);

}  // namespace pcl_bv
