// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>
#include <string_view>

namespace [[gnu::visibility("default")]] pcl_bv {

/// The definition of a type of types.h or results.h that has a name ("std_msgs/msg/Header"), as recordings
/// hold it (encoding "ros2msg"): its .msg text, then that of each type it is made of after a line of 80 '='
/// and "MSG: package/Type". Throws std::invalid_argument for another name.
std::string schema_of(std::string_view type);

}  // namespace pcl_bv
