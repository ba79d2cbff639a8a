// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Points in temporary files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "pcl_bv/numeric/coordinates.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv::detail {

/// A record has the coordinates of a point and its number in the cloud, in 8 bytes. Other bytes may follow.
inline constexpr std::size_t kNumberBytes = sizeof(std::uint64_t);
/// Set in the number of a point that belongs to another brick.
inline constexpr std::uint64_t kOfOtherBrick = std::uint64_t{1} << 63;
/// Set in the number of a point that belongs to the brick and that other bricks have, too.
inline constexpr std::uint64_t kInOtherBricks = std::uint64_t{1} << 62;
/// Set in the number of a core point of a share.
inline constexpr std::uint64_t kCore = std::uint64_t{1} << 61;
inline constexpr std::uint64_t kNumberMask = kCore - 1;

constexpr std::size_t point_bytes(ScalarType scalar) {
  return 3 * size_of(scalar);
}
constexpr std::size_t record_bytes(ScalarType scalar) {
  return point_bytes(scalar) + kNumberBytes;
}

inline std::uint64_t number_of_record(const std::byte* record, ScalarType scalar) {
  std::uint64_t number;
  std::memcpy(&number, record + point_bytes(scalar), sizeof number);
  return number;
}

/// Writes a point's coordinates in the scalar type of the cloud, which is exact.
void write_coordinates(const Coordinates& point, ScalarType scalar, std::byte* to);

/// Returns a view of the points of records.
PointView view_of_records(const std::vector<std::byte>& records, std::size_t step, ScalarType scalar);

}  // namespace pcl_bv::detail
