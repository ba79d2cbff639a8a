// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Parsing, formatting and normalising of the up direction, the direction against gravity.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Parses an up direction. `text` is `x`, `y`, `z`, `-x`, `-y` or `-z`, or three finite numbers `X,Y,Z` that
/// are not all 0. The numbers are not normalised. Throws std::invalid_argument for other text, with the text
/// and what is allowed.
Eigen::Vector3d parse_up(std::string_view text);

/// Returns a text that parse_up() reads as this vector. For a unit vector along an axis the text is the name
/// of the axis, e.g. `-y`. Otherwise it is `X,Y,Z` with the fewest digits that read back exactly. parse_up()
/// rejects the text of a vector that is 0 or not finite.
std::string format_up(const Eigen::Vector3d& up);

/// Returns the unit vector along `up`, which may have any length above 0. The result is exact if `up` is
/// along an axis. Parallel vectors give the same bits if the ratio of their lengths is a power of two. Throws
/// std::invalid_argument if `up` is 0 or not finite.
Eigen::Vector3d normalized_up(const Eigen::Vector3d& up);

}  // namespace detail
}  // namespace pcl_bv
