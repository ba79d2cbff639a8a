// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <string>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/messages/types.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns a view of the message's points without a copy. The view is valid as long as the message's data.
/// Returns an empty view for a cloud without points, whatever its fields are.
///
/// Returns nullopt if a view is not possible. raw_cloud_of() reads all layouts. A view needs this layout:
/// - The fields x, y and z are adjacent in this order. X, Y or Z is used if the lower-case name is missing.
/// - All three are float32 or all three are float64, in this machine's byte order.
/// - The rows have no padding. If the data has exactly the bytes that the points need, row_step is ignored.
///
/// Throws MessageError (serialize.h) if the data is too short for the points, if point_step is 0, if row_step
/// is shorter than a row or too long for the data, or if x, y or z is missing, of an unknown type or outside
/// of the record.
std::optional<PointView> view_points(const msg::PointCloud2& cloud);

/// Returns a view of the intensities (see intensity_of()) without a copy. Returns nullopt if there is no
/// intensity, or if view_points() returns nullopt. Throws as view_points().
std::optional<FieldView> view_intensity(const msg::PointCloud2& cloud);

/// Returns a view of the times of the points (see times_of()). Otherwise like view_intensity().
std::optional<FieldView> view_times(const msg::PointCloud2& cloud);

/// Returns a line for the user that names at most three of the fields that raw_cloud_of() leaves out, with
/// the reasons, and says if the data has bytes for more points. Otherwise returns an empty text. Throws as
/// view_points().
std::string skipped_fields_note(const msg::PointCloud2& cloud);

/// Returns a copy of the cloud, row by row without padding, little-endian. If x, y or z is missing, X, Y or Z
/// is used instead and renamed. The coordinates become float32 if all three are float32 or integers of 8 or
/// 16 bits, which float32 represents exactly. Otherwise they become float64. Other fields keep their types. A
/// field is left out for one of these reasons:
/// - Its type is unknown.
/// - It exceeds the record.
/// - It is a second x, y or z.
/// - It would make the records of the copy longer than twice point_step.
///
/// RawCloud::note is skipped_fields_note(). A cloud without points gives an empty cloud. Throws as
/// view_points(). Takes linear time in the number of points.
RawCloud raw_cloud_of(const msg::PointCloud2& cloud);

}  // namespace detail
}  // namespace pcl_bv
