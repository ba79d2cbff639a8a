// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>
#include <string_view>

namespace [[gnu::visibility("default")]] pcl_bv {

/// Returns the definition of a type of types.h, results.h, polygon.h, livox.h or compressed_cloud.h in the
/// encoding "ros2msg" of recordings. `type` is a name such as "std_msgs/msg/Header". The definition is the
/// .msg text of the type, then the .msg text of each type that it uses. A line of 80 '=' and a line "MSG:
/// package/Type" come before the text of each used type. Throws std::invalid_argument for unknown types.
std::string schema_of(std::string_view type);

}  // namespace pcl_bv
