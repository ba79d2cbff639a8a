// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "gpu_context.h"

namespace pcl_bv::detail {

/// A buffer with its own memory. Owns both. The context must outlive it.
class DeviceBuffer {
 public:
  /// Makes an uninitialised buffer of at least one byte. Throws GpuError.
  DeviceBuffer(GpuContext& context, std::size_t bytes, BufferUse use);

  /// Takes over memory of another program, of which `fd` is an opaque handle, and makes a buffer of its first
  /// bytes. On success, the driver owns `fd`; after an exception, the caller does. Throws GpuError, also if
  /// the device cannot import memory.
  static std::unique_ptr<DeviceBuffer> import(GpuContext& context, int fd, std::size_t memory_bytes,
                                              std::size_t buffer_bytes);

  ~DeviceBuffer();
  DeviceBuffer(const DeviceBuffer&) = delete;
  DeviceBuffer& operator=(const DeviceBuffer&) = delete;

  VkBuffer handle() const { return buffer_; }
  std::size_t bytes() const { return bytes_; }
  /// The memory as the processor sees it; null if it is not mapped.
  std::byte* mapped() const { return mapped_; }

 private:
  DeviceBuffer(GpuContext& context, std::size_t bytes);
  void make(BufferUse use);
  void make_imported(int fd, std::size_t memory_bytes);
  void allocate(std::uint32_t type, std::size_t bytes, const void* next);

  GpuContext& context_;
  std::size_t bytes_;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  std::byte* mapped_ = nullptr;
};

/// A buffer for the time of one function. Its memory comes from an earlier one if possible, because drivers
/// take up to milliseconds to allocate memory. Can be larger than requested.
class ScratchBuffer {
 public:
  ScratchBuffer(GpuContext& context, std::size_t bytes, BufferUse use)
      : context_(context), use_(use), buffer_(context.borrow_buffer(bytes, use)) {}
  ~ScratchBuffer() { context_.return_buffer(std::move(buffer_), use_); }
  ScratchBuffer(const ScratchBuffer&) = delete;
  ScratchBuffer& operator=(const ScratchBuffer&) = delete;

  operator const DeviceBuffer&() const { return *buffer_; }
  const DeviceBuffer* get() const { return buffer_.get(); }
  std::byte* mapped() const { return buffer_->mapped(); }

 private:
  GpuContext& context_;
  BufferUse use_;
  std::unique_ptr<DeviceBuffer> buffer_;
};

}  // namespace pcl_bv::detail
