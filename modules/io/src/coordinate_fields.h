// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {

/// Offsets of x, y, z in the record.
struct CoordinateFields {
  std::array<std::size_t, 3> offset{};
  ScalarType scalar = ScalarType::float32;
  bool readable = false;  ///< All three exist, as single float32 or as single float64.
  bool adjacent = false;  ///< They lie side by side in that order, so that a PointView fits.
};

CoordinateFields coordinate_fields(const std::vector<PointField>& fields);

/// The coordinates of these records, where they lie; for fields that are adjacent.
PointView view_at(const CoordinateFields& fields, const std::byte* records, std::size_t count,
                  std::size_t point_step);

/// Copies the coordinates of these records to where packed_points() finds them.
void pack_coordinates(const CoordinateFields& fields, const std::byte* records, std::size_t count,
                      std::size_t point_step, std::byte* xyz);

/// Throws `Error` unless x, y and z exist, each once, in a form that is readable: IoError for readers.
template <typename Error = IoError>
void check_coordinates(const std::vector<PointField>& fields);

}  // namespace pcl_bv
