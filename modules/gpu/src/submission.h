// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <vector>

#include "compute_pipeline.h"
#include "device_buffer.h"

namespace pcl_bv::detail {

/// A part of a buffer as a shader sees it. `offset` must be a multiple of GpuContext::binding_alignment().
struct Binding {
  const DeviceBuffer* buffer;
  std::size_t offset = 0;
  std::size_t bytes = VK_WHOLE_SIZE;
};

/// Whether a command waits for the commands before it.
enum class Order : std::uint8_t {
  after_earlier,   ///< It sees what they have written.
  beside_previous  ///< It runs at the same time as the command before it.
};

/// A list of commands for the device.
class Submission {
 public:
  explicit Submission(std::shared_ptr<GpuContext> context);
  ~Submission();
  Submission(const Submission&) = delete;
  Submission& operator=(const Submission&) = delete;

  void copy(const DeviceBuffer& from, std::size_t from_offset, const DeviceBuffer& to, std::size_t to_offset,
            std::size_t bytes, Order order = Order::after_earlier);
  void fill(const DeviceBuffer& buffer, std::size_t offset, std::size_t bytes, std::uint32_t value,
            Order order = Order::after_earlier);

  /// Runs a shader with `groups` workgroups, at most 65535. `push` has the size that the shader declares.
  template <typename Push>
  void dispatch(const ComputePipeline& pipeline, std::initializer_list<Binding> bindings, const Push& push,
                std::uint32_t groups, Order order = Order::after_earlier) {
    dispatch(pipeline, bindings, &push, sizeof push, groups, order);
  }

  /// Executes the commands and waits for them. To be called once.
  void run() {
    start();
    wait();
  }
  /// Lets the device execute the commands. To be called once, before wait().
  void start();
  /// Waits for the commands. The destructor waits, too, if this was not called.
  void wait();

 private:
  void dispatch(const ComputePipeline& pipeline, std::initializer_list<Binding> bindings, const void* push,
                std::size_t push_bytes, std::uint32_t groups, Order order);
  VkDescriptorSet descriptors(const ComputePipeline& pipeline, std::initializer_list<Binding> bindings);
  void begin_command(Order order);

  std::shared_ptr<GpuContext> context_;
  CommandSlot slot_;
  std::vector<VkDescriptorPool> more_pools_;  // that follow the one of the slot
  std::size_t sets_in_pool_ = 0;
  bool pending_ = false;  // whether the device may still execute the commands
};

}  // namespace pcl_bv::detail
