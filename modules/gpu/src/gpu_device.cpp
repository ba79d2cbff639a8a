// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/gpu/gpu_device.h"

#include "device_choice.h"
#include "gpu_context.h"

namespace pcl_bv {

std::string_view gpu_kind_name(GpuKind kind) {
  constexpr std::string_view names[] = {"discrete", "integrated", "virtual", "other", "software"};
  return names[static_cast<std::size_t>(kind)];
}

std::vector<GpuInfo> gpu_devices() {
  const detail::VulkanInstance instance(false);
  return detail::describe(instance, instance.devices());
}

GpuDevice::GpuDevice(std::string_view which, const GpuOptions& options)
    : context_(std::make_shared<detail::GpuContext>(which, options)) {}

const GpuInfo& GpuDevice::info() const {
  return context_->info();
}

bool GpuDevice::lost() const {
  return context_->lost();
}

std::vector<std::string> GpuDevice::validation_messages() const {
  return context_->validation_messages();
}

}  // namespace pcl_bv
