// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#define RCLCPP_COMPONENTS_REGISTER_NODE(component)
