// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "gpu_context.h"

#include <algorithm>
#include <chrono>

#include "compute_pipeline.h"
#include "device_buffer.h"
#include "device_choice.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kSmallestBinding = std::size_t{1} << 20;
constexpr std::size_t kLargestBinding = std::size_t{128} << 20;

// A wait is given up after this time. A pass takes at most seconds, also on software drivers; a driver
// that hangs does not always say so.
constexpr std::uint64_t kNanosecondsToWait = 600'000'000'000;

// Waits shorter than this poll: a driver takes 20 to 40 us to wake a thread that sleeps, as long as it takes
// to process 10^6 points. Software drivers need the processor for themselves.
constexpr std::chrono::microseconds kTimeToPoll(1000);

constexpr std::uint32_t kBuffersPerSet = 8;

// The memory of free buffers. The results of 65535 clusters take 14 MiB, on the device and mapped, and two
// such slices are computed at a time.
constexpr std::size_t kMostFreeBytes = std::size_t{128} << 20;

const GpuOptions& checked(const GpuOptions& options) {
  if (options.max_binding < kSmallestBinding)
    throw std::invalid_argument("GpuOptions::max_binding is " + std::to_string(options.max_binding) +
                                ", must be at least 1048576 bytes");
  return options;
}

}  // namespace

GpuContext::GpuContext(std::string_view which, const GpuOptions& options)
    : instance_(checked(options).validation), max_binding_(std::min(options.max_binding, kLargestBinding)) {
  vk = instance_.vk;
  choose(which);
  open_device();
}

GpuContext::~GpuContext() {
  for (const CommandSlot& slot : free_slots_)
    destroy_slot(slot);
  pipelines_.clear();
  free_buffers_.clear();
  vk.vkDestroyDevice(device, nullptr);
}

void GpuContext::choose(std::string_view which) {
  const std::vector<VkPhysicalDevice> devices = instance_.devices();
  const std::vector<GpuInfo> described = describe(instance_, devices);
  info_ = described[choose_device(described, which)];
  physical_ = devices[info_.number];
  vk.vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
  VkPhysicalDeviceProperties properties;
  vk.vkGetPhysicalDeviceProperties(physical_, &properties);
  max_binding_ = std::min<std::size_t>(max_binding_, properties.limits.maxStorageBufferRange);
  binding_alignment_ = properties.limits.minStorageBufferOffsetAlignment;
  shares_memory_ = info_.kind == GpuKind::integrated || info_.kind == GpuKind::software;
}

void GpuContext::open_device() {
  std::uint32_t count = 0;
  vk.vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vk.vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
  while (queue_family_ + 1 < count && (families[queue_family_].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0)
    ++queue_family_;
  const float priority = 1;
  auto queue = vulkan_struct<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue.queueFamilyIndex = queue_family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  const char* const extension = VK_KHR_EXTERNAL_MEMORY_FD_EXTENSION_NAME;
  auto created = vulkan_struct<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  created.queueCreateInfoCount = 1;
  created.pQueueCreateInfos = &queue;
  created.enabledExtensionCount = info_.imports ? 1 : 0;
  created.ppEnabledExtensionNames = &extension;
  check(vk.vkCreateDevice(physical_, &created, nullptr, &device), "open the device");
  vk.load(device);
  vk.vkGetDeviceQueue(device, queue_family_, 0, &queue_);
}

void GpuContext::fail(GpuFailure failure, const std::string& what) const {
  throw GpuError(failure, info_.name + ": " + what);
}

void GpuContext::check(VkResult result, const char* what) {
  switch (result) {
    case VK_SUCCESS:
      return;
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_FRAGMENTED_POOL:
    case VK_ERROR_TOO_MANY_OBJECTS:
      fail(GpuFailure::out_of_memory, std::string("too little memory to ") + what);
    case VK_TIMEOUT:
    case VK_ERROR_DEVICE_LOST:
      lost_ = true;
      fail(GpuFailure::lost, "the device was lost");
    default:
      fail(GpuFailure::other,
           std::string("failed to ") + what + " (Vulkan error " + std::to_string(result) + ")");
  }
}

void GpuContext::require_alive() const {
  if (lost_) fail(GpuFailure::lost, "the device was lost");
}

std::uint32_t GpuContext::memory_type(std::uint32_t allowed,
                                      std::initializer_list<VkMemoryPropertyFlags> wishes) const {
  for (const VkMemoryPropertyFlags wish : wishes) {
    for (std::uint32_t type = 0; type < memory_.memoryTypeCount; ++type) {
      const bool has_all = (memory_.memoryTypes[type].propertyFlags & wish) == wish;
      if ((allowed >> type & 1) != 0 && has_all) return type;
    }
  }
  fail(GpuFailure::other, "no memory of the kind that a buffer needs");
}

const ComputePipeline& GpuContext::pipeline(Shader shader, const std::vector<std::uint32_t>& constants) {
  require_alive();
  const std::lock_guard lock(mutex_);
  std::unique_ptr<ComputePipeline>& made = pipelines_[{shader, constants}];
  if (made == nullptr) made = std::make_unique<ComputePipeline>(*this, shader, constants);
  return *made;
}

std::unique_ptr<DeviceBuffer> GpuContext::borrow_buffer(std::size_t bytes, BufferUse use) {
  require_alive();
  {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(free_buffers_.begin(), free_buffers_.end(), [&](const auto& entry) {
      return entry.first == use && entry.second->bytes() >= bytes;
    });
    if (found != free_buffers_.end()) {
      std::unique_ptr<DeviceBuffer> buffer = std::move(found->second);
      free_buffers_.erase(found);
      free_bytes_ -= buffer->bytes();
      return buffer;
    }
  }
  return std::make_unique<DeviceBuffer>(*this, bytes, use);
}

void GpuContext::return_buffer(std::unique_ptr<DeviceBuffer> buffer, BufferUse use) {
  const std::lock_guard lock(mutex_);
  if (lost_ || free_bytes_ + buffer->bytes() > kMostFreeBytes) return;  // which frees it
  free_bytes_ += buffer->bytes();
  // Small ones come first, so that a small request does not take a large one.
  const auto larger = std::find_if(free_buffers_.begin(), free_buffers_.end(), [&](const auto& entry) {
    return entry.second->bytes() > buffer->bytes();
  });
  free_buffers_.emplace(larger, use, std::move(buffer));
}

CommandSlot GpuContext::borrow_slot() {
  require_alive();
  {
    const std::lock_guard lock(mutex_);
    if (!free_slots_.empty()) {
      const CommandSlot slot = free_slots_.back();
      free_slots_.pop_back();
      return slot;
    }
  }
  CommandSlot slot;
  try {
    make_slot(slot);
  } catch (...) {
    destroy_slot(slot);
    throw;
  }
  return slot;
}

void GpuContext::make_slot(CommandSlot& slot) {
  auto pool = vulkan_struct<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  pool.queueFamilyIndex = queue_family_;
  check(vk.vkCreateCommandPool(device, &pool, nullptr, &slot.pool), "make a command pool");
  auto commands = vulkan_struct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  commands.commandPool = slot.pool;
  commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  commands.commandBufferCount = 1;
  check(vk.vkAllocateCommandBuffers(device, &commands, &slot.commands), "make a command buffer");
  const auto fence = vulkan_struct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
  check(vk.vkCreateFence(device, &fence, nullptr, &slot.fence), "make a fence");
  slot.descriptors = make_descriptor_pool();
}

VkDescriptorPool GpuContext::make_descriptor_pool() {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kSetsPerPool * kBuffersPerSet};
  auto info = vulkan_struct<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  info.maxSets = kSetsPerPool;
  info.poolSizeCount = 1;
  info.pPoolSizes = &size;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  check(vk.vkCreateDescriptorPool(device, &info, nullptr, &pool), "make descriptors");
  return pool;
}

void GpuContext::return_slot(const CommandSlot& slot) {
  // A lost device may still execute the commands, so nothing is used again.
  if (lost_ || vk.vkResetCommandPool(device, slot.pool, 0) != VK_SUCCESS ||
      vk.vkResetDescriptorPool(device, slot.descriptors, 0) != VK_SUCCESS)
    return destroy_slot(slot);
  const std::lock_guard lock(mutex_);
  free_slots_.push_back(slot);
}

void GpuContext::destroy_slot(const CommandSlot& slot) {
  vk.vkDestroyFence(device, slot.fence, nullptr);
  vk.vkDestroyDescriptorPool(device, slot.descriptors, nullptr);
  vk.vkDestroyCommandPool(device, slot.pool, nullptr);
}

VkResult GpuContext::wait_for(VkFence fence) const {
  if (info_.kind != GpuKind::software) {
    const auto end = std::chrono::steady_clock::now() + kTimeToPoll;
    VkResult status = VK_NOT_READY;
    while (status == VK_NOT_READY && std::chrono::steady_clock::now() < end)
      status = vk.vkGetFenceStatus(device, fence);
    if (status != VK_NOT_READY) return status;
  }
  return vk.vkWaitForFences(device, 1, &fence, VK_TRUE, kNanosecondsToWait);
}

void GpuContext::start(const CommandSlot& slot) {
  require_alive();
  check(vk.vkEndCommandBuffer(slot.commands), "record commands");
  auto submit = vulkan_struct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &slot.commands;
  {
    const std::lock_guard lock(mutex_);
    check(vk.vkQueueSubmit(queue_, 1, &submit, slot.fence), "submit commands");
  }
}

void GpuContext::wait(const CommandSlot& slot) {
  check(wait_for(slot.fence), "wait for the device");
  check(vk.vkResetFences(device, 1, &slot.fence), "reset a fence");
}

void GpuContext::wait_noexcept(const CommandSlot& slot) noexcept {
  if (lost_) return;
  try {
    wait(slot);
  } catch (...) {
    lost_ = true;  // so that nothing is used again that the device may still write
  }
}

}  // namespace pcl_bv::detail
