// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// An open device: instance, logical device, one queue for compute and copies, and the pipelines made so far.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pcl_bv/gpu/gpu_device.h"
#include "vulkan_api.h"

namespace pcl_bv::detail {

class ComputePipeline;
class DeviceBuffer;

/// Where the memory of a buffer is.
enum class BufferUse : std::uint8_t {
  device,   ///< In the device's own memory. Mapped only if the device shares memory with the processor.
  upload,   ///< Mapped; the processor writes and the device reads.
  download  ///< Mapped; the device writes and the processor reads.
};

enum class Shader : std::uint8_t;

/// Destroys the instance at the end.
class VulkanInstance {
 public:
  explicit VulkanInstance(bool validation);
  ~VulkanInstance();
  VulkanInstance(const VulkanInstance&) = delete;
  VulkanInstance& operator=(const VulkanInstance&) = delete;

  /// Returns the devices with Vulkan 1.1 and a queue for compute.
  std::vector<VkPhysicalDevice> devices() const;

  std::vector<std::string> messages() const;

  VulkanApi vk;
  VkInstance handle = VK_NULL_HANDLE;

 private:
  struct Log {
    std::mutex mutex;
    std::vector<std::string> messages;
  };
  static VkBool32 VKAPI_PTR record(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                   const VkDebugUtilsMessengerCallbackDataEXT* data, void* log);

  std::unique_ptr<Log> log_;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

/// Descriptor sets per descriptor pool.
inline constexpr std::uint32_t kSetsPerPool = 32;

/// A command pool with its command buffer, descriptors and fence. Submissions borrow and return them.
struct CommandSlot {
  VkCommandPool pool = VK_NULL_HANDLE;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkDescriptorPool descriptors = VK_NULL_HANDLE;
  VkFence fence = VK_NULL_HANDLE;
};

class GpuContext {
 public:
  GpuContext(std::string_view which, const GpuOptions& options);
  ~GpuContext();
  GpuContext(const GpuContext&) = delete;
  GpuContext& operator=(const GpuContext&) = delete;

  const GpuInfo& info() const { return info_; }
  bool lost() const { return lost_; }
  std::vector<std::string> validation_messages() const { return instance_.messages(); }

  /// Bytes that one binding of a shader may have: the limits of the device and of the options.
  std::size_t max_binding() const { return max_binding_; }
  std::size_t binding_alignment() const { return binding_alignment_; }

  /// Whether the processor reads and writes the device's memory as fast as its own.
  bool shares_memory() const { return shares_memory_; }

  /// Returns the first memory type of `allowed` (a bit each) that has all properties of the first possible
  /// element of `wishes`. Throws GpuError if no element is possible.
  std::uint32_t memory_type(std::uint32_t allowed, std::initializer_list<VkMemoryPropertyFlags> wishes) const;

  /// Throws GpuError unless `result` is a success. `what` completes "NAME: failed to ...".
  void check(VkResult result, const char* what);
  /// Throws GpuError if the device was lost.
  void require_alive() const;

  /// Returns the pipeline of a shader with these specialization constants. Makes it at the first call.
  const ComputePipeline& pipeline(Shader shader, const std::vector<std::uint32_t>& constants);

  /// Returns a buffer of at least `bytes`, for ScratchBuffer. Its content is undefined.
  std::unique_ptr<DeviceBuffer> borrow_buffer(std::size_t bytes, BufferUse use);
  /// Keeps a borrowed buffer for the next one who borrows, or frees it if many are kept already.
  void return_buffer(std::unique_ptr<DeviceBuffer> buffer, BufferUse use);

  CommandSlot borrow_slot();
  void return_slot(const CommandSlot& slot);
  VkDescriptorPool make_descriptor_pool();
  /// Ends the recording and submits it.
  void start(const CommandSlot& slot);
  /// Waits until the device has executed what was submitted.
  void wait(const CommandSlot& slot);
  /// Waits like wait(). A failure marks the device as lost.
  void wait_noexcept(const CommandSlot& slot) noexcept;

  VulkanApi vk;
  VkDevice device = VK_NULL_HANDLE;

 private:
  void choose(std::string_view which);
  void open_device();
  void make_slot(CommandSlot& slot);
  void destroy_slot(const CommandSlot& slot);
  VkResult wait_for(VkFence fence) const;
  [[noreturn]] void fail(GpuFailure failure, const std::string& what) const;

  VulkanInstance instance_;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkPhysicalDeviceMemoryProperties memory_{};
  VkQueue queue_ = VK_NULL_HANDLE;
  std::uint32_t queue_family_ = 0;
  GpuInfo info_;
  std::size_t max_binding_;
  std::size_t binding_alignment_ = 1;
  bool shares_memory_ = false;
  std::atomic<bool> lost_ = false;
  std::mutex mutex_;  // protects the queue, the slots, the pipelines and the free buffers
  std::vector<CommandSlot> free_slots_;
  std::vector<std::pair<BufferUse, std::unique_ptr<DeviceBuffer>>> free_buffers_;
  std::size_t free_bytes_ = 0;  // of free_buffers_
  std::map<std::pair<Shader, std::vector<std::uint32_t>>, std::unique_ptr<ComputePipeline>> pipelines_;
};

}  // namespace pcl_bv::detail
