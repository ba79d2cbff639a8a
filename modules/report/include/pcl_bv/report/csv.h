// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Volumes as lines of comma-separated values, for spreadsheets and data frames.
#pragma once

#include <string>
#include <string_view>

#include "pcl_bv/report/report.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// The names of the columns that every line ends with. cx, cy, cz is center(); sx, sy, sz the full size along
/// the shape's own axes, which the unit quaternion qx, qy, qz, qw turns the world's axes into (without one
/// they are the world's). Of a k-DOP, as of every shape without such axes, it is that of its axis-aligned
/// box. A sphere has only a radius; a cylinder or capsule has one too, and its axis is its z. What a shape
/// does not have stays empty; so do all numbers of an empty volume.
inline constexpr std::string_view csv_columns =
    "cluster,points,method,cx,cy,cz,sx,sy,sz,qx,qy,qz,qw,radius,volume";

/// What follows of a cluster that may be a track: velocity and pose of TrackEntry. Empty until it is born.
inline constexpr std::string_view csv_track_columns = "vx,vy,vz,x,y,z,yaw";

/// A text as one field (RFC 4180): in double quotes, with those inside doubled, where it holds a comma, a
/// quote or a line end; else as it is.
std::string csv_field(std::string_view text);

/// Appends a line for each volume of the cluster: `first_columns` (fields joined by commas), then
/// csv_columns and, if `tracked`, csv_track_columns. Lines end in "\n". Numbers have the fewest digits that
/// read back as exactly the same double. Throws std::domain_error if one is not finite, which no fitted
/// volume has.
void append_csv(std::string_view first_columns, const ClusterEntry& cluster, std::string& text,
                bool tracked = false);

/// The lines of all clusters of the report, with its file as the first column. Nothing for a failed report.
std::string report_csv(const Report& report);

/// The line that comes before those of report_csv(): "file," and csv_columns.
std::string report_csv_heading();

}  // namespace pcl_bv
