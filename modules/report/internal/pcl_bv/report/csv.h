// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes volumes as lines of comma-separated values for spreadsheets and data frames.
#pragma once

#include <string>
#include <string_view>

#include "pcl_bv/report/report.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Names of the columns of every volume.
/// - cx, cy, cz: the center().
/// - sx, sy, sz: the full size along the shape's own axes. For an upright box (obb-yaw, obb-lshape), this
///   size is the length, width and height. The own z axis of a cylinder or capsule is along the axis of the
///   shape. A prism has the size of its outline along its first two axes, and its height.
/// - qx, qy, qz, qw: the unit quaternion that rotates the world's axes to the shape's axes.
/// - radius: the radius of a sphere, cylinder or capsule. A sphere has no size.
///
/// For shapes without own axes (such as k-DOPs), the quaternion is empty and the size is that of the
/// axis-aligned box. Columns that a shape does not have are empty. All numbers of an empty volume are empty.
inline constexpr std::string_view kCsvColumns =
    "cluster,points,method,cx,cy,cz,sx,sy,sz,qx,qy,qz,qw,radius,volume";

/// Names of the columns of a track, which are TrackEntry::velocity and TrackEntry::pose. For a cluster
/// without a track, the columns are empty.
inline constexpr std::string_view kCsvTrackColumns = "vx,vy,vz,x,y,z,yaw";

/// Names of the last columns: the full lengths of an upright box along its axes 0, 1 and 2, and Obb::yaw() in
/// radians. The columns are empty for all other volumes. For a box without a track, axis 0 is along the
/// longer horizontal side, and the yaw is from -pi/2 to pi/2. For the box of a track, axis 0 points to the
/// front of the object, and the yaw is from -pi to pi.
inline constexpr std::string_view kCsvUprightColumns = "length,width,height,yaw";

/// Like kCsvUprightColumns, but for lines that also have kCsvTrackColumns. In such lines, the column "yaw" is
/// the yaw of the track, and "box_yaw" is the yaw of the box.
inline constexpr std::string_view kCsvTrackedUprightColumns = "length,width,height,box_yaw";

/// Returns a text as one CSV field (RFC 4180). A text with a comma, a quote or a line end is put in double
/// quotes, and its quotes are doubled. Any other text is unchanged.
std::string csv_field(std::string_view text);

/// Appends a line for each volume of the cluster. A line has `first_columns` (fields joined by commas), then
/// the columns of kCsvColumns, of kCsvTrackColumns if `tracked`, and of kCsvUprightColumns. A line ends in
/// "\n". Numbers have the fewest digits that read back as exactly the same double. Throws std::domain_error
/// if a number is not finite, which does not occur in fitted volumes.
void append_csv(std::string_view first_columns, const ClusterEntry& cluster, std::string& text,
                bool tracked = false);

/// Returns the lines of all clusters of the report. The first column is the report's file. Returns an empty
/// text for a failed report.
std::string report_csv(const Report& report);
/// Writes the lines of report_csv() to `take` piece by piece. The clusters are those of `clusters`;
/// report.clusters is ignored.
void write_report_csv(const Report& report, const ClusterSource& clusters, const TextSink& take);

/// Returns the heading of report_csv(), which is "file", kCsvColumns and kCsvUprightColumns.
std::string report_csv_heading();

/// Returns the heading for the lines of frames, which is "seq,stamp_ns,track", kCsvColumns, kCsvTrackColumns
/// and kCsvTrackedUprightColumns.
std::string frames_csv_heading();

}  // namespace detail
}  // namespace pcl_bv
