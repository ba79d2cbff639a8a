// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cstring>

#include "gpu_context.h"

namespace pcl_bv::detail {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

void require_validation_layer(const VulkanApi& vk) {
  std::uint32_t count = 0;
  vk.vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vk.vkEnumerateInstanceLayerProperties(&count, layers.data());
  for (const VkLayerProperties& layer : layers) {
    if (std::strcmp(layer.layerName, kValidationLayer) == 0) return;
  }
  throw GpuError(GpuFailure::other, std::string("the layer ") + kValidationLayer + " is not installed");
}

bool has_compute_queue(const VulkanApi& vk, VkPhysicalDevice device) {
  std::uint32_t count = 0;
  vk.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vk.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  for (const VkQueueFamilyProperties& family : families) {
    if ((family.queueFlags & VK_QUEUE_COMPUTE_BIT) != 0 && family.queueCount > 0) return true;
  }
  return false;
}

}  // namespace

VkBool32 VKAPI_PTR VulkanInstance::record(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* log) {
  Log& into = *static_cast<Log*>(log);
  const std::lock_guard lock(into.mutex);
  into.messages.emplace_back(data->pMessage);
  return VK_FALSE;
}

VulkanInstance::VulkanInstance(bool validation) : vk(VulkanApi::open()), log_(std::make_unique<Log>()) {
  auto application = vulkan_struct<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  application.pApplicationName = "pcl_bv";
  application.apiVersion = VK_API_VERSION_1_1;
  auto info = vulkan_struct<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pApplicationInfo = &application;
  auto log_info = vulkan_struct<VkDebugUtilsMessengerCreateInfoEXT>(
      VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
  log_info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  log_info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  log_info.pfnUserCallback = record;
  log_info.pUserData = log_.get();
  const char* const extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  if (validation) {
    require_validation_layer(vk);
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kValidationLayer;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
    info.pNext = &log_info;
  }
  const VkResult result = vk.vkCreateInstance(&info, nullptr, &handle);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
    throw GpuError(GpuFailure::no_device, "no driver for Vulkan is installed");
  if (result != VK_SUCCESS)
    throw GpuError(GpuFailure::other, "Vulkan cannot be started (error " + std::to_string(result) + ")");
  vk.load(handle);
  if (!validation) return;
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vk.vkGetInstanceProcAddr(handle, "vkCreateDebugUtilsMessengerEXT"));
  if (create != nullptr) create(handle, &log_info, nullptr, &messenger_);
}

VulkanInstance::~VulkanInstance() {
  if (messenger_ != VK_NULL_HANDLE) {
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vk.vkGetInstanceProcAddr(handle, "vkDestroyDebugUtilsMessengerEXT"));
    destroy(handle, messenger_, nullptr);
  }
  vk.vkDestroyInstance(handle, nullptr);
}

std::vector<VkPhysicalDevice> VulkanInstance::devices() const {
  std::uint32_t count = 0;
  vk.vkEnumeratePhysicalDevices(handle, &count, nullptr);
  std::vector<VkPhysicalDevice> all(count);
  if (vk.vkEnumeratePhysicalDevices(handle, &count, all.data()) < 0) return {};
  std::vector<VkPhysicalDevice> usable;
  for (const VkPhysicalDevice device : all) {
    VkPhysicalDeviceProperties properties;
    vk.vkGetPhysicalDeviceProperties(device, &properties);
    if (properties.apiVersion >= VK_API_VERSION_1_1 && has_compute_queue(vk, device))
      usable.push_back(device);
  }
  return usable;
}

std::vector<std::string> VulkanInstance::messages() const {
  const std::lock_guard lock(log_->mutex);
  return log_->messages;
}

}  // namespace pcl_bv::detail
