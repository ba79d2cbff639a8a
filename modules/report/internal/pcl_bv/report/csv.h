// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes volumes as lines of comma-separated values, for spreadsheets and data frames.
#pragma once

#include <string>
#include <string_view>

#include "pcl_bv/report/report.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Names of the columns of every volume. cx, cy, cz is center(). sx, sy, sz is the full size along the
/// shape's own axes; the unit quaternion qx, qy, qz, qw rotates the world's axes to the shape's. For shapes
/// without own axes (such as k-DOPs) the quaternion is empty and the size is that of the axis-aligned box. A
/// sphere has a radius and no size. A cylinder or capsule has both, and its axis is its own z. An upright box
/// (obb-yaw, obb-lshape) has its length, width and height in sx, sy and sz. Columns that a shape does not
/// have are empty, as are all numbers of an empty volume.
inline constexpr std::string_view kCsvColumns =
    "cluster,points,method,cx,cy,cz,sx,sy,sz,qx,qy,qz,qw,radius,volume";

/// Names of the columns of a track: velocity and pose of TrackEntry. Empty for a cluster without a track.
inline constexpr std::string_view kCsvTrackColumns = "vx,vy,vz,x,y,z,yaw";

/// Names of the last columns: full length (along axis 0), width (along axis 1) and height (along axis 2) of
/// an upright box, and Obb::yaw() in radians. Empty for all other volumes. For a track's box the length is
/// along its front, and the yaw is from -pi to pi. For other boxes the length is not below the width, and the
/// yaw is from -pi/2 to pi/2.
inline constexpr std::string_view kCsvUprightColumns = "length,width,height,yaw";

/// Like kCsvUprightColumns, for lines with kCsvTrackColumns, where "yaw" is already the yaw of the object.
inline constexpr std::string_view kCsvTrackedUprightColumns = "length,width,height,box_yaw";

/// Returns a text as one CSV field (RFC 4180): in double quotes, with inner quotes doubled, if it has a
/// comma, a quote or a line end; else unchanged.
std::string csv_field(std::string_view text);

/// Appends a line for each volume of the cluster: `first_columns` (fields joined by commas), kCsvColumns,
/// kCsvTrackColumns if `tracked`, and kCsvUprightColumns. Lines end in "\n". Numbers have the fewest digits
/// that read back as exactly the same double. Throws std::domain_error if a number is not finite, which does
/// not occur in fitted volumes.
void append_csv(std::string_view first_columns, const ClusterEntry& cluster, std::string& text,
                bool tracked = false);

/// Returns the lines of all clusters of the report, with its file as the first column. Returns an empty text
/// for a failed report.
std::string report_csv(const Report& report);
/// Writes the same lines piece by piece, of these clusters instead of the report's.
void write_report_csv(const Report& report, const ClusterSource& clusters, const TextSink& take);

/// Returns the heading of report_csv(): "file", kCsvColumns and kCsvUprightColumns.
std::string report_csv_heading();

/// Returns the heading for lines of frames: "seq,stamp_ns,track", kCsvColumns, kCsvTrackColumns and
/// kCsvTrackedUprightColumns.
std::string frames_csv_heading();

}  // namespace pcl_bv
