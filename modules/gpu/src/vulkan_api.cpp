// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "vulkan_api.h"

#include <dlfcn.h>

#include <string>

#include "pcl_bv/gpu/gpu_device.h"

namespace pcl_bv::detail {
namespace {

// The loader stays open: drivers may have started threads that run its code until the process ends.
PFN_vkGetInstanceProcAddr open_loader() {
  static void* const library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr)
    throw GpuError(GpuFailure::no_loader, "the Vulkan loader libvulkan.so.1 is not installed");
  return reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
}

}  // namespace

VulkanApi VulkanApi::open() {
  VulkanApi api;
  api.vkGetInstanceProcAddr = open_loader();
  if (api.vkGetInstanceProcAddr != nullptr) {
#define PCL_BV_LOAD(name) \
  api.name = reinterpret_cast<PFN_##name>(api.vkGetInstanceProcAddr(VK_NULL_HANDLE, #name));
    PCL_BV_VULKAN_GLOBAL(PCL_BV_LOAD)
#undef PCL_BV_LOAD
  }
  std::uint32_t version = 0;
  const bool known =
      api.vkEnumerateInstanceVersion != nullptr && api.vkEnumerateInstanceVersion(&version) == VK_SUCCESS;
  if (!known || version < VK_API_VERSION_1_1)
    throw GpuError(GpuFailure::no_loader, "the Vulkan loader libvulkan.so.1 is older than Vulkan 1.1");
  return api;
}

void VulkanApi::load(VkInstance instance) {
#define PCL_BV_LOAD(name) name = reinterpret_cast<PFN_##name>(vkGetInstanceProcAddr(instance, #name));
  PCL_BV_VULKAN_INSTANCE(PCL_BV_LOAD)
#undef PCL_BV_LOAD
}

void VulkanApi::load(VkDevice device) {
#define PCL_BV_LOAD(name) name = reinterpret_cast<PFN_##name>(vkGetDeviceProcAddr(device, #name));
  PCL_BV_VULKAN_DEVICE(PCL_BV_LOAD)
  PCL_BV_LOAD(vkGetMemoryFdPropertiesKHR)
#undef PCL_BV_LOAD
}

}  // namespace pcl_bv::detail
