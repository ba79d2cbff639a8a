// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <visualization_msgs/MarkerArray.h>

namespace visualization_msgs::msg {

using visualization_msgs::MarkerArray;

}  // namespace visualization_msgs::msg
