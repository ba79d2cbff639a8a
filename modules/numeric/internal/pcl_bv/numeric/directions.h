// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The directions of the k-DOPs of Karlsson, Winberg and Larsson 2010, in the order that the whole library
// uses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A direction through a face, corner or edge of the unit cube. The components are -1, 0 or 1; the direction
/// is not normalised.
using CubeDirection = std::array<std::int8_t, 3>;
// clang-format off
inline constexpr std::array<CubeDirection, 13> kCubeDirections = {{
    {1, 0, 0}, {0, 1, 0}, {0, 0, 1},                                      // through the faces
    {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1},                       // through the corners
    {1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1},  // through the edges
}};
// clang-format on
inline constexpr std::size_t kMaxDirections = kCubeDirections.size();

/// A subset of kCubeDirections, in the same order. The number in the name counts both sides of each slab.
enum class DirectionSet : std::uint8_t { dop6, dop14, dop18, dop26 };

/// Returns the number of directions of a set: 3, 7, 9 or 13.
constexpr std::size_t direction_count(DirectionSet set) {
  constexpr std::size_t counts[] = {3, 7, 9, 13};
  return counts[static_cast<std::size_t>(set)];
}

/// Returns the index in kCubeDirections of the k-th direction of a set (dop18 skips the corners).
constexpr std::size_t cube_direction(DirectionSet set, std::size_t k) {
  return set == DirectionSet::dop18 && k >= 3 ? k + 4 : k;
}

}  // namespace detail
}  // namespace pcl_bv
