// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <memory>

#include "gpu_context.h"

namespace pcl_bv::detail {

/// Where the memory of a buffer is.
enum class BufferUse : std::uint8_t {
  device,   ///< In the device's own memory. Mapped only if the device shares memory with the processor.
  upload,   ///< Mapped; the processor writes and the device reads.
  download  ///< Mapped; the device writes and the processor reads.
};

/// A buffer with its own memory. Owns both; keeps the device open.
class DeviceBuffer {
 public:
  /// Makes an uninitialised buffer of at least one byte. Throws GpuError.
  DeviceBuffer(std::shared_ptr<GpuContext> context, std::size_t bytes, BufferUse use);

  /// Takes over memory of another program, of which `fd` is an opaque handle. On success, the driver owns
  /// `fd`; after an exception, the caller does. Throws GpuError, also if the device cannot import memory.
  static std::unique_ptr<DeviceBuffer> import(std::shared_ptr<GpuContext> context, int fd, std::size_t bytes);

  ~DeviceBuffer();
  DeviceBuffer(const DeviceBuffer&) = delete;
  DeviceBuffer& operator=(const DeviceBuffer&) = delete;

  VkBuffer handle() const { return buffer_; }
  std::size_t bytes() const { return bytes_; }
  /// The memory as the processor sees it; null if it is not mapped.
  std::byte* mapped() const { return mapped_; }

 private:
  DeviceBuffer(std::shared_ptr<GpuContext> context, std::size_t bytes);
  void make(BufferUse use);
  void make_imported(int fd);
  void allocate(std::uint32_t type, std::size_t bytes, const void* next);

  std::shared_ptr<GpuContext> context_;
  std::size_t bytes_;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  std::byte* mapped_ = nullptr;
};

}  // namespace pcl_bv::detail
