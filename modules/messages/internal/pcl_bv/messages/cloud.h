// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <string>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/messages/types.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// The points of a message where they lie: x, y and z (X, Y and Z where there is no lower-case one) side by
/// side, all float32 or all float64, in this machine's byte order, rows without padding between them. nullopt
/// for other layouts, which raw_cloud_of() takes. A cloud without points is empty, whatever its fields are.
/// Where the data are just as many bytes as the points need, rows have no padding, whatever row_step says.
/// Throws MessageError (serialize.h) for a cloud that does not fit its data, or without x, y and z that can
/// be read.
std::optional<PointView> points_in_place(const msg::PointCloud2& cloud);

/// intensity_of() where it lies in the message; nullopt where there is none, or none that can be read in
/// place.
std::optional<FieldView> intensity_in_place(const msg::PointCloud2& cloud);

/// Which fields raw_cloud_of() leaves out and why, a line for people; mostly empty. Throws as
/// points_in_place().
std::string unread_fields(const msg::PointCloud2& cloud);

/// A copy with the fields, row by row without padding, little-endian; X, Y and Z become x, y and z. Where x,
/// y and z are neither all float32 nor all float64 they become float32 if all are integers of 16 bits or
/// float32, else float64: no value changes. Other fields that are of no known type, reach out of the record
/// or make the fields longer than two records are left out, and `note` is unread_fields(). Throws as
/// points_in_place(). O(points).
RawCloud raw_cloud_of(const msg::PointCloud2& cloud);

}  // namespace pcl_bv
