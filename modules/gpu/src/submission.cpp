// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "submission.h"

#include <utility>

namespace pcl_bv::detail {
Submission::Submission(std::shared_ptr<GpuContext> context)
    : context_(std::move(context)), slot_(context_->borrow_slot()) {
  auto begin = vulkan_struct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  const VkResult result = context_->vk.vkBeginCommandBuffer(slot_.commands, &begin);
  if (result != VK_SUCCESS) context_->return_slot(slot_);
  context_->check(result, "record commands");
}

Submission::~Submission() {
  if (pending_) context_->wait_noexcept(slot_);
  for (const VkDescriptorPool pool : more_pools_)
    context_->vk.vkDestroyDescriptorPool(context_->device, pool, nullptr);
  context_->return_slot(slot_);
}

void Submission::begin_command(Order order) {
  if (order == Order::beside_previous) return;
  auto barrier = vulkan_struct<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT |
                          VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT |
                          VK_ACCESS_HOST_READ_BIT;
  constexpr VkPipelineStageFlags stages =
      VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
  context_->vk.vkCmdPipelineBarrier(slot_.commands, stages, stages | VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                                    &barrier, 0, nullptr, 0, nullptr);
}

void Submission::copy(const DeviceBuffer& from, std::size_t from_offset, const DeviceBuffer& to,
                      std::size_t to_offset, std::size_t bytes, Order order) {
  begin_command(order);
  const VkBufferCopy part{from_offset, to_offset, bytes};
  context_->vk.vkCmdCopyBuffer(slot_.commands, from.handle(), to.handle(), 1, &part);
}

void Submission::fill(const DeviceBuffer& buffer, std::size_t offset, std::size_t bytes, std::uint32_t value,
                      Order order) {
  begin_command(order);
  context_->vk.vkCmdFillBuffer(slot_.commands, buffer.handle(), offset, bytes, value);
}

VkDescriptorSet Submission::descriptors(const ComputePipeline& pipeline,
                                        std::initializer_list<Binding> bindings) {
  const VulkanApi& vk = context_->vk;
  if (sets_in_pool_ == kSetsPerPool) {
    more_pools_.push_back(context_->make_descriptor_pool());
    sets_in_pool_ = 0;
  }
  auto info = vulkan_struct<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  info.descriptorPool = more_pools_.empty() ? slot_.descriptors : more_pools_.back();
  info.descriptorSetCount = 1;
  info.pSetLayouts = &pipeline.bindings;
  VkDescriptorSet set = VK_NULL_HANDLE;
  context_->check(vk.vkAllocateDescriptorSets(context_->device, &info, &set), "make descriptors");
  ++sets_in_pool_;

  std::vector<VkDescriptorBufferInfo> buffers;
  for (const Binding& binding : bindings)
    buffers.push_back({binding.buffer->handle(), binding.offset, binding.bytes});
  std::vector<VkWriteDescriptorSet> writes(
      buffers.size(), vulkan_struct<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET));
  for (std::uint32_t i = 0; i < writes.size(); ++i) {
    writes[i].dstSet = set;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    writes[i].pBufferInfo = &buffers[i];
  }
  vk.vkUpdateDescriptorSets(context_->device, static_cast<std::uint32_t>(writes.size()), writes.data(), 0,
                            nullptr);
  return set;
}

void Submission::dispatch(const ComputePipeline& pipeline, std::initializer_list<Binding> bindings,
                          const void* push, std::size_t push_bytes, std::uint32_t groups, Order order) {
  const VulkanApi& vk = context_->vk;
  const VkDescriptorSet set = descriptors(pipeline, bindings);
  begin_command(order);
  vk.vkCmdBindPipeline(slot_.commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline);
  vk.vkCmdBindDescriptorSets(slot_.commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout, 0, 1, &set, 0,
                             nullptr);
  vk.vkCmdPushConstants(slot_.commands, pipeline.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                        static_cast<std::uint32_t>(push_bytes), push);
  vk.vkCmdDispatch(slot_.commands, groups, 1, 1);
}

void Submission::start() {
  begin_command(Order::after_earlier);  // the processor sees what the last command has written
  context_->start(slot_);
  pending_ = true;
}

void Submission::wait() {
  context_->wait(slot_);
  pending_ = false;
}

}  // namespace pcl_bv::detail
