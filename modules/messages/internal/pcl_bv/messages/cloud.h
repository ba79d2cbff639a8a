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
/// The fields x, y and z (or X, Y and Z if the lower-case name is missing) must be adjacent in this order,
/// all float32 or all float64, in this machine's byte order, and rows must have no padding. Returns nullopt
/// for other layouts. Use raw_cloud_of() for them. Returns an empty view for a cloud without points, whatever
/// its fields are. If the data has exactly the bytes that the points need, row_step is ignored, because rows
/// then have no padding. Throws MessageError (serialize.h) if the data is too short for the points, or if x,
/// y or z is missing, of an unknown type or outside of the record.
std::optional<PointView> view_points(const msg::PointCloud2& cloud);

/// Returns a view of the intensities (see intensity_of()) without a copy. Returns nullopt if there is no
/// intensity, or if view_points() returns nullopt. Throws as view_points().
std::optional<FieldView> view_intensity(const msg::PointCloud2& cloud);

/// Returns a line for the user that names fields which raw_cloud_of() leaves out, and why. Returns an empty
/// text if there are none. Throws as view_points().
std::string skipped_fields_note(const msg::PointCloud2& cloud);

/// Returns a copy of the cloud, row by row without padding, little-endian. X, Y and Z are renamed to x, y and
/// z. The coordinates become float32 if float32 represents the types of all three exactly (float32, integers
/// of 8 or 16 bits), else float64. Other fields keep their types. A field is left out for one of these
/// reasons:
/// - Its type is unknown.
/// - It exceeds the record.
/// - It is a second x, y or z.
/// - It would make the new records longer than twice point_step.
///
/// RawCloud::note is then skipped_fields_note(). A cloud without points gives an empty cloud. Throws as
/// view_points(). Takes linear time in the number of points.
RawCloud raw_cloud_of(const msg::PointCloud2& cloud);

}  // namespace detail
}  // namespace pcl_bv
