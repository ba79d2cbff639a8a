// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The types of messages that are clouds, in the spelling of ROS 2, and clouds with all their fields.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/nodes/topics.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns the type of clouds with this name, such as "sensor_msgs/msg/PointCloud2". Returns nullopt for
/// other messages.
std::optional<CloudType> cloud_type_of(std::string_view ros_type);

/// Returns the names for which cloud_type_of() returns a type. The first one is PointCloud2.
const std::vector<std::string>& cloud_type_names();

/// Returns a copy of the cloud in a message, with all its fields. Throws as read_cloud_message().
RawCloud raw_cloud_in(const CloudMessage& message);

}  // namespace detail
}  // namespace pcl_bv
