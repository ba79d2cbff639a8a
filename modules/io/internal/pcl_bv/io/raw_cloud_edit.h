// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Creates clouds from coordinates, adds label fields to clouds, and reads integer fields.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns a cloud of width n and height 1 with the float32 fields x, y, z, copied bit for bit from n triples
/// x y z. Throws std::invalid_argument if the number of floats is not a multiple of three.
RawCloud make_cloud(const std::vector<float>& xyz);

/// Sets the uint32 field `name` of every point. If the cloud has a field of this name, of any type, the new
/// field replaces it. Otherwise the new field is appended to the record. All other fields keep their values
/// and order.
///
/// Throws std::invalid_argument if there is not one value per point, or if the name is empty, contains white
/// space, or is "_" (padding) or a coordinate (x, y, z, X, Y, Z).
void set_uint32_field(RawCloud& cloud, std::string_view name, const std::vector<std::uint32_t>& values);

/// Returns the first field of this name, which must hold one integer per point. Throws std::runtime_error if
/// there is no such field. The message then lists the existing fields. Also throws std::runtime_error if the
/// field is floating point, has several elements per point, is unsigned with 8 bytes, or is in
/// RawCloud::invalid_fields.
const PointField& integer_field(const RawCloud& cloud, std::string_view name);

/// Copies the values of an integer_field() from `count` records of `point_step` bytes.
void copy_integers(const PointField& field, const std::byte* records, std::size_t count,
                   std::size_t point_step, std::int64_t* to);

/// Returns the values of an integer field, one per point. Throws as integer_field().
std::vector<std::int64_t> integers_of(const RawCloud& cloud, std::string_view name);

/// Recomputes `packed_xyz` from `data`. Call it after changing `data` or `fields`. `packed_xyz` is filled if
/// RawCloud::xyz() needs a copy. This is the case if the fields x, y and z exist with one element each but
/// are not adjacent in this order as one floating-point type. Otherwise `packed_xyz` becomes empty. Throws
/// IoError for integer coordinates above 2^53 in magnitude.
void update_packed_xyz(RawCloud& cloud);

}  // namespace detail
}  // namespace pcl_bv
