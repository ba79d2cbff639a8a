// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Volumes as lines of comma-separated values, for spreadsheets and data frames.
#pragma once

#include <string>
#include <string_view>

#include "pcl_bv/report/report.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// The names of the columns of every volume. cx, cy, cz is center(); sx, sy, sz the full size along
/// the shape's own axes, which the unit quaternion qx, qy, qz, qw turns the world's axes into (without one
/// they are the world's). Of a k-DOP, as of every shape without such axes, it is that of its axis-aligned
/// box. A sphere has only a radius; a cylinder or capsule has one too, and its axis is its z; an upright box
/// (obb-yaw, obb-lshape) has its length, width and height in sx, sy and sz. What a shape does not have stays
/// empty; so do all numbers of an empty volume.
inline constexpr std::string_view csv_columns =
    "cluster,points,method,cx,cy,cz,sx,sy,sz,qx,qy,qz,qw,radius,volume";

/// What follows of a cluster that may be a track: velocity and pose of TrackEntry. Empty until it is born.
inline constexpr std::string_view csv_track_columns = "vx,vy,vz,x,y,z,yaw";

/// The last columns: full length (along axis 0), width and height (along axis 2) of an upright box, and
/// Obb::yaw(), radians. Empty for all other volumes. Of a track's box the length is along its front, and the
/// yaw from -pi to pi; of any other the length is not below the width, and the yaw from -pi/2 to pi/2.
inline constexpr std::string_view csv_upright_columns = "length,width,height,yaw";

/// The same where csv_track_columns come before, which have a yaw: that of the object.
inline constexpr std::string_view csv_tracked_upright_columns = "length,width,height,box_yaw";

/// A text as one field (RFC 4180): in double quotes, with those inside doubled, where it holds a comma, a
/// quote or a line end; else as it is.
std::string csv_field(std::string_view text);

/// Appends a line for each volume of the cluster: `first_columns` (fields joined by commas), then
/// csv_columns, if `tracked` csv_track_columns, and csv_upright_columns. Lines end in "\n". Numbers have the
/// fewest digits that read back as exactly the same double. Throws std::domain_error if one is not finite,
/// which no fitted volume has.
void append_csv(std::string_view first_columns, const ClusterEntry& cluster, std::string& text,
                bool tracked = false);

/// The lines of all clusters of the report, with its file as the first column. Nothing for a failed report.
std::string report_csv(const Report& report);
void write_report_csv(const Report& report, const ClusterSource& clusters, const TextSink& take);

/// The line that comes before those of report_csv(): "file", csv_columns and csv_upright_columns.
std::string report_csv_heading();

/// The line before those of frames: "seq,stamp_ns,track", csv_columns, csv_track_columns and
/// csv_tracked_upright_columns.
std::string frames_csv_heading();

}  // namespace pcl_bv
