// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Building and extending clouds for the writers: labels beside the input's own fields, generated points.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A cloud of width n and height 1 with the float32 fields x, y, z, from n triples "x y z", kept to the bit.
/// Throws std::invalid_argument if the number of floats is no multiple of three.
RawCloud make_cloud(const std::vector<float>& xyz);

/// Gives every point a uint32 `name`: in the place of the field of that name, whatever its type was, else at
/// the end of the record. All other fields keep their values and order.
///
/// Throws std::invalid_argument if there is not one value per point, or if the name is empty, holds white
/// space, is "_" (padding) or that of a coordinate (x, y, z, X, Y, Z).
void set_uint32_field(RawCloud& cloud, std::string_view name, const std::vector<std::uint32_t>& values);

/// The values of an integer field, of one element a point, one for each point; where fields share the name,
/// of the first. Throws std::runtime_error if there is no such field (the message lists those there are), if
/// it is floating point or has several elements, if it is unsigned and of 8 bytes, or if values of it could
/// not be read.
std::vector<std::int64_t> integers_of(const RawCloud& cloud, std::string_view name);

/// Brings `packed_xyz` in line with `data`, as every reader does last: filled if fields x, y and z that
/// xyz() can view exist but do not lie side by side in that order as one floating-point type, else empty.
/// Throws IoError for integers beyond 2^53.
void update_packed_xyz(RawCloud& cloud);

}  // namespace pcl_bv
