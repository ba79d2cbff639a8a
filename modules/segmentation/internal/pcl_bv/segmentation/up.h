// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

namespace [[gnu::visibility("default")]] pcl_bv {

/// Reads a direction against gravity: `x`, `y`, `z`, `-x`, `-y` or `-z`, or three numbers `X,Y,Z`, finite and
/// not all 0, kept as they are. Anything else throws std::invalid_argument naming the text and what is
/// allowed.
Eigen::Vector3d parse_up(std::string_view text);

/// What parse_up() reads as this vector: the name of an axis of unit length, else `X,Y,Z` with the fewest
/// digits that read back exactly. Of a vector that is no direction a text that parse_up() refuses.
std::string up_text(const Eigen::Vector3d& up);

/// The unit vector along `up`, which may have any length above 0: exact along an axis, and the same bits for
/// all lengths whose ratio is a power of two. Throws std::invalid_argument if `up` is 0 or not finite.
Eigen::Vector3d up_direction(const Eigen::Vector3d& up);

}  // namespace pcl_bv
