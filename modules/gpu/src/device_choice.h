// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string_view>
#include <vector>

#include "gpu_context.h"

namespace pcl_bv::detail {

/// Returns the description of each device.
std::vector<GpuInfo> describe(const VulkanInstance& instance, const std::vector<VkPhysicalDevice>& devices);

/// Returns the number of the device that `which` names, as GpuDevice defines it. Throws GpuError (no_device),
/// with the devices there are.
std::size_t choose_device(const std::vector<GpuInfo>& devices, std::string_view which);

}  // namespace pcl_bv::detail
