// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <ros/node_handle.h>

#include "pcl_bv/nodes/stream_config.h"

namespace pcl_bv {

/// The parameters of a namespace as a configuration: `preset` first, then the file `config`, then parameters with the
/// keys of such a file. Throws ConfigError for an unknown key and for a value that is not allowed.
StreamConfig config_of(const ros::NodeHandle& parameters);

}  // namespace pcl_bv
