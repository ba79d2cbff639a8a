// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "device_choice.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>

namespace pcl_bv::detail {
namespace {

GpuKind kind_of(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return GpuKind::discrete;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return GpuKind::integrated;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return GpuKind::virtual_machine;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return GpuKind::software;
    default:
      return GpuKind::other;
  }
}

bool imports_memory(const VulkanApi& vk, VkPhysicalDevice device) {
  std::uint32_t count = 0;
  vk.vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vk.vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
  return std::any_of(extensions.begin(), extensions.end(), [](const VkExtensionProperties& e) {
    return std::strcmp(e.extensionName, VK_KHR_EXTERNAL_MEMORY_FD_EXTENSION_NAME) == 0;
  });
}

std::size_t largest_heap(const VulkanApi& vk, VkPhysicalDevice device) {
  VkPhysicalDeviceMemoryProperties memory;
  vk.vkGetPhysicalDeviceMemoryProperties(device, &memory);
  VkDeviceSize largest = 0;
  for (std::uint32_t h = 0; h < memory.memoryHeapCount; ++h) {
    if ((memory.memoryHeaps[h].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0)
      largest = std::max(largest, memory.memoryHeaps[h].size);
  }
  return largest;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::string names_of(const std::vector<GpuInfo>& devices) {
  std::string names;
  for (const GpuInfo& device : devices)
    names += (names.empty() ? "" : ", ") + std::to_string(device.number) + " '" + device.name + "'";
  return names.empty() ? "there is none" : "there are: " + names;
}

}  // namespace

std::vector<GpuInfo> describe(const VulkanInstance& instance, const std::vector<VkPhysicalDevice>& devices) {
  std::vector<GpuInfo> all;
  for (const VkPhysicalDevice device : devices) {
    VkPhysicalDeviceProperties properties;
    instance.vk.vkGetPhysicalDeviceProperties(device, &properties);
    all.push_back({all.size(), properties.deviceName, kind_of(properties.deviceType),
                   largest_heap(instance.vk, device), properties.limits.maxStorageBufferRange,
                   imports_memory(instance.vk, device)});
  }
  return all;
}

std::size_t choose_device(const std::vector<GpuInfo>& devices, std::string_view which) {
  if (which == "auto") {
    const auto best = std::min_element(devices.begin(), devices.end(),
                                       [](const GpuInfo& a, const GpuInfo& b) { return a.kind < b.kind; });
    if (best != devices.end() && best->kind != GpuKind::software) return best->number;
    throw GpuError(GpuFailure::no_device,
                   "no graphics card with Vulkan 1.1 was found (" + names_of(devices) + ")");
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(which.data(), which.data() + which.size(), number);
  const bool is_number = error == std::errc() && end == which.data() + which.size();
  for (const GpuInfo& device : devices) {
    const bool named = !which.empty() && lower(device.name).find(lower(which)) != std::string::npos;
    if (is_number ? device.number == number : named) return device.number;
  }
  throw GpuError(GpuFailure::no_device,
                 "no device for Vulkan is '" + std::string(which) + "' (" + names_of(devices) + ")");
}

}  // namespace pcl_bv::detail
