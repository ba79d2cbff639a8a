// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The functions of Vulkan as pointers. libvulkan is opened at run time, so that programs need neither it nor
// a driver to start.
#pragma once

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan_core.h>

namespace pcl_bv::detail {

/// Returns a structure of Vulkan whose members are 0, except for its type.
template <typename Struct>
Struct vulkan_struct(VkStructureType type) {
  Struct made{};
  made.sType = type;
  return made;
}

// clang-format off
#define PCL_BV_VULKAN_GLOBAL(X) \
  X(vkCreateInstance) X(vkEnumerateInstanceVersion) X(vkEnumerateInstanceLayerProperties)
#define PCL_BV_VULKAN_INSTANCE(X) \
  X(vkDestroyInstance) X(vkEnumeratePhysicalDevices) X(vkGetPhysicalDeviceProperties) \
  X(vkGetPhysicalDeviceMemoryProperties) X(vkGetPhysicalDeviceQueueFamilyProperties) \
  X(vkEnumerateDeviceExtensionProperties) X(vkCreateDevice) X(vkGetDeviceProcAddr)
#define PCL_BV_VULKAN_DEVICE(X) \
  X(vkDestroyDevice) X(vkGetDeviceQueue) X(vkDeviceWaitIdle) \
  X(vkAllocateMemory) X(vkFreeMemory) X(vkMapMemory) X(vkCreateBuffer) X(vkDestroyBuffer) \
  X(vkGetBufferMemoryRequirements) X(vkBindBufferMemory) \
  X(vkCreateShaderModule) X(vkDestroyShaderModule) X(vkCreateDescriptorSetLayout) \
  X(vkDestroyDescriptorSetLayout) X(vkCreatePipelineLayout) X(vkDestroyPipelineLayout) \
  X(vkCreateComputePipelines) X(vkDestroyPipeline) X(vkCreateDescriptorPool) X(vkDestroyDescriptorPool) X(vkResetDescriptorPool) \
  X(vkAllocateDescriptorSets) X(vkUpdateDescriptorSets) \
  X(vkCreateCommandPool) X(vkDestroyCommandPool) X(vkResetCommandPool) X(vkAllocateCommandBuffers) \
  X(vkBeginCommandBuffer) X(vkEndCommandBuffer) X(vkCreateFence) X(vkDestroyFence) X(vkResetFences) \
  X(vkWaitForFences) X(vkGetFenceStatus) X(vkQueueSubmit) \
  X(vkCmdBindPipeline) X(vkCmdBindDescriptorSets) X(vkCmdPushConstants) X(vkCmdDispatch) \
  X(vkCmdCopyBuffer) X(vkCmdFillBuffer) X(vkCmdPipelineBarrier)
// clang-format on

/// One pointer for each function. Tests replace pointers to simulate failures.
struct VulkanApi {
#define PCL_BV_MEMBER(name) PFN_##name name = nullptr;
  PCL_BV_VULKAN_GLOBAL(PCL_BV_MEMBER)
  PCL_BV_VULKAN_INSTANCE(PCL_BV_MEMBER)
  PCL_BV_VULKAN_DEVICE(PCL_BV_MEMBER)
#undef PCL_BV_MEMBER
  PFN_vkGetInstanceProcAddr vkGetInstanceProcAddr = nullptr;
  PFN_vkGetMemoryFdPropertiesKHR vkGetMemoryFdPropertiesKHR = nullptr;  // null without the extension

  /// Opens the loader at the first call, and fills in the global functions. Throws GpuError (no_loader).
  static VulkanApi open();

  /// Fills in the functions of an instance or of a device.
  void load(VkInstance instance);
  void load(VkDevice device);
};

}  // namespace pcl_bv::detail
