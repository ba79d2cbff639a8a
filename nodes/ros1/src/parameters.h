// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads the configuration from ROS parameters.
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "pcl_bv/nodes/stream_runner.h"

namespace pcl_bv {
using namespace detail;

/// The configuration of a node.
struct NodeConfig : StreamConfig {
  std::vector<std::string> publish;  ///< Names of adapter_kinds() whose messages are published.
  std::string parameters;            ///< All parameters found, such as "preset: road, cluster/tolerance: 1".
};

/// Returns the configuration from the parameters of a namespace. Applies the parameter `preset`, then the
/// file that the parameter `config` names, then the parameters whose names are keys of such a file. The
/// parameter `publish` is a list or a text with commas. Throws ConfigError for an unknown key or an invalid
/// value, which names the parameter and how to remove it.
NodeConfig config_of(const ros::NodeHandle& parameters);

}  // namespace pcl_bv
