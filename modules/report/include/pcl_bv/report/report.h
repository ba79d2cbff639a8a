// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What was found in one input, as plain data, and its two written forms: JSON for programs, a table for
// people.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/segmentation/cloud_statistics.h"
#include "pcl_bv/segmentation/counts.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

struct VolumeEntry {
  std::string method;  ///< The canonical name, never an alias: "dop26".
  AnyVolume volume;
  std::optional<std::size_t> outside;  ///< Points that exact arithmetic found outside, if it was asked.
  std::string failed{};                ///< If the fit failed and left the volume empty, why; else nothing.
};

/// An object that is followed from frame to frame.
struct TrackEntry {
  std::uint32_t id = 0;  ///< Never given to another object.
  std::size_t age = 0;   ///< Frames since the first sighting, that one included.
  /// Units of the points a second: in the fixed frame where the sensor's pose is known, else relative to the
  /// sensor, in its frame.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  bool moving = false;  ///< Over the ground, where the sensor's motion is known; else relative to the sensor.
  /// x, y, z of the centre and the yaw, in radians, of where it faces; in the frame of `velocity`. The yaw is
  /// that of the motion over the ground; until it has moved, of the longer side.
  std::array<double, 4> pose{};
  /// Of x, y, z, yaw, vx, vy: the upper triangle, row by row, of a positive definite matrix.
  std::array<double, 21> covariance{};

  friend bool operator==(const TrackEntry& a, const TrackEntry& b) {
    return a.id == b.id && a.age == b.age && a.velocity == b.velocity && a.moving == b.moving &&
           a.pose == b.pose && a.covariance == b.covariance;
  }
};

struct ClusterEntry {
  std::size_t id = 0;
  std::size_t points = 0;  ///< Valid points.
  std::vector<VolumeEntry> volumes;
  std::optional<std::int64_t> class_value{};  ///< None unless points are told apart by class.
  std::optional<TrackEntry> track{};          ///< None without tracking, and until the track is born.
};

/// Wall-clock time of each stage.
struct Seconds {
  double read = 0;
  double segment = 0;
  double fit = 0;
};

/// What the cloud of an input is like. Organised clouds have height > 1.
struct CloudInfo : CloudStatistics {
  std::size_t width = 0;
  std::size_t height = 1;
  std::vector<PointField> fields;
};

/// One input. If `error` is set the input failed and only `file` and `error` mean anything.
struct Report {
  std::string file;                  ///< As the user named it; invalid UTF-8 is replaced where it is written.
  std::optional<std::size_t> parts;  ///< Of how many inputs, if it is one cloud in several.
  std::size_t points = 0;            ///< All points of the input, good or bad.
  std::optional<Eigen::Vector3d> origin;  ///< What was subtracted from all coordinates, if something was.
  Counts counts;
  std::vector<ClusterEntry> clusters;
  std::optional<CloudInfo> info;
  std::optional<Seconds> seconds;
  std::optional<std::string> error;
};

/// Clusters one after another, each made when it is asked for: in a vector a million take 500 MB.
struct ClusterSource {
  std::size_t count = 0;
  std::function<const ClusterEntry&(std::size_t)> at;  ///< Valid until the next call.
};

/// Those of a vector, which must outlive it.
ClusterSource source_of(const std::vector<ClusterEntry>& clusters);

/// Takes a text piece by piece. It may leave the piece as it is; the next one is another text.
using TextSink = std::function<void(std::string& piece)>;

/// The report as one JSON object on one line, without the line's end.
///
/// Every number has the fewest digits that read back as exactly the same double, so that the volume read back
/// holds every point that the stored one holds; there is no null, no NaN and no -0. An empty volume is
/// `"empty":true`, one whose fit failed `"failed"` with the reason; both have no numbers. Throws
/// std::domain_error if a number is not finite, which no fitted volume has.
std::string report_json(const Report& report);

/// The same text in pieces of about a megabyte, with these clusters instead of the report's.
void write_report_json(const Report& report, const ClusterSource& clusters, const TextSink& take);

/// The report as a table of at most 120 columns: a line on the file, then one row for each volume with its
/// centre, size and volume in the unit of the points. The sizes of upright boxes are length, width and
/// height, and they have a yaw, radians (Obb::yaw()). Rounded for reading: use JSON to compute. A failed
/// report gives no text.
std::string report_text(const Report& report);
void write_report_text(const Report& report, const ClusterSource& clusters, const TextSink& take);

}  // namespace pcl_bv
