// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>
#include <string_view>

namespace [[gnu::visibility("default")]] pcl_bv {

/// Returns the definition of a type of types.h or results.h ("std_msgs/msg/Header") in the encoding "ros2msg"
/// of recordings: its .msg text, then the .msg text of each type that it uses, each after a line of 80 '='
/// and a line "MSG: package/Type". Throws std::invalid_argument for unknown types.
std::string schema_of(std::string_view type);

}  // namespace pcl_bv
