// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The direction against gravity: parsing, formatting and normalising.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

namespace [[gnu::visibility("default")]] pcl_bv {

/// Parses a direction against gravity: `x`, `y`, `z`, `-x`, `-y` or `-z`, or three numbers `X,Y,Z`, finite
/// and not all 0, which are not normalised. Throws std::invalid_argument for other text, with the text and
/// what is allowed.
Eigen::Vector3d parse_up(std::string_view text);

/// Returns a text that parse_up() reads as this vector: the name of an axis for a unit vector along it, else
/// `X,Y,Z` with the fewest digits that read back exactly. For a vector that is no direction, parse_up()
/// rejects the text.
std::string format_up(const Eigen::Vector3d& up);

/// Returns the unit vector along `up`, which may have any length above 0. It is exact along an axis, and has
/// the same bits for all lengths whose ratio is a power of two. Throws std::invalid_argument if `up` is 0 or
/// not finite.
Eigen::Vector3d normalized_up(const Eigen::Vector3d& up);

}  // namespace pcl_bv
