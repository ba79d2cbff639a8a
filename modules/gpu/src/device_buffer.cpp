// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "device_buffer.h"

#include <fcntl.h>

#include <algorithm>
#include <string>
#include <utility>

namespace pcl_bv::detail {
namespace {

constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags kMapped =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

VkBufferCreateInfo description(std::size_t bytes) {
  auto info = vulkan_struct<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = bytes;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
               VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  return info;
}

}  // namespace

DeviceBuffer::DeviceBuffer(GpuContext& context, std::size_t bytes)
    : context_(context), bytes_(std::max<std::size_t>(bytes, 4)) {
  context_.require_alive();
}

DeviceBuffer::DeviceBuffer(GpuContext& context, std::size_t bytes, BufferUse use)
    : DeviceBuffer(context, bytes) {
  make(use);  // the destructor runs if this throws, because the other constructor has finished
}

std::unique_ptr<DeviceBuffer> DeviceBuffer::import(GpuContext& context, int fd, std::size_t memory_bytes,
                                                   std::size_t buffer_bytes) {
  std::unique_ptr<DeviceBuffer> buffer(new DeviceBuffer(context, buffer_bytes));
  buffer->make_imported(fd, memory_bytes);
  return buffer;
}

DeviceBuffer::~DeviceBuffer() {
  context_.vk.vkDestroyBuffer(context_.device, buffer_, nullptr);
  context_.vk.vkFreeMemory(context_.device, memory_, nullptr);  // which also unmaps it
}

void DeviceBuffer::allocate(std::uint32_t type, std::size_t bytes, const void* next) {
  auto info = vulkan_struct<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  info.pNext = next;
  info.allocationSize = bytes;
  info.memoryTypeIndex = type;
  context_.check(context_.vk.vkAllocateMemory(context_.device, &info, nullptr, &memory_),
                 "allocate a buffer");
  context_.check(context_.vk.vkBindBufferMemory(context_.device, buffer_, memory_, 0), "allocate a buffer");
}

void DeviceBuffer::make(BufferUse use) {
  const VulkanApi& vk = context_.vk;
  const VkBufferCreateInfo info = description(bytes_);
  context_.check(vk.vkCreateBuffer(context_.device, &info, nullptr, &buffer_), "make a buffer");
  VkMemoryRequirements needs;
  vk.vkGetBufferMemoryRequirements(context_.device, buffer_, &needs);
  const bool mapped = use != BufferUse::device || context_.shares_memory();
  std::uint32_t type = 0;
  if (use == BufferUse::download) {
    type = context_.memory_type(needs.memoryTypeBits, {kMapped | kCached, kMapped});
  } else if (use == BufferUse::upload) {
    type = context_.memory_type(needs.memoryTypeBits, {kMapped});
  } else if (mapped) {
    type =
        context_.memory_type(needs.memoryTypeBits, {kLocal | kMapped | kCached, kLocal | kMapped, kMapped});
  } else {
    type = context_.memory_type(needs.memoryTypeBits, {kLocal, 0});
  }
  allocate(type, needs.size, nullptr);
  if (!mapped) return;
  void* address = nullptr;
  context_.check(vk.vkMapMemory(context_.device, memory_, 0, VK_WHOLE_SIZE, 0, &address), "map a buffer");
  mapped_ = static_cast<std::byte*>(address);
}

void DeviceBuffer::make_imported(int fd, std::size_t memory_bytes) {
  const VulkanApi& vk = context_.vk;
  if (!context_.info().imports)
    throw GpuError(GpuFailure::other,
                   context_.info().name + ": the driver cannot use memory of other programs");
  // NVIDIA's driver accepts a number that is no open file.
  if (::fcntl(fd, F_GETFD) == -1)
    throw GpuError(GpuFailure::other,
                   context_.info().name + ": " + std::to_string(fd) + " is no open file descriptor");
  auto external =
      vulkan_struct<VkExternalMemoryBufferCreateInfo>(VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_BUFFER_CREATE_INFO);
  external.handleTypes = VK_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD_BIT;
  VkBufferCreateInfo info = description(bytes_);
  info.pNext = &external;
  context_.check(vk.vkCreateBuffer(context_.device, &info, nullptr, &buffer_), "make a buffer");
  VkMemoryRequirements needs;
  vk.vkGetBufferMemoryRequirements(context_.device, buffer_, &needs);
  auto imported = vulkan_struct<VkImportMemoryFdInfoKHR>(VK_STRUCTURE_TYPE_IMPORT_MEMORY_FD_INFO_KHR);
  imported.handleType = VK_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD_BIT;
  imported.fd = fd;
  if (needs.size > memory_bytes)
    throw GpuError(GpuFailure::other, context_.info().name +
                                          ": the imported memory is too small, buffers need " +
                                          std::to_string(needs.size) + " bytes");
  // The size must be that of the exporter's allocation.
  allocate(context_.memory_type(needs.memoryTypeBits, {kLocal, 0}), memory_bytes, &imported);
}

}  // namespace pcl_bv::detail
