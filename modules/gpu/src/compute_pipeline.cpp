// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "compute_pipeline.h"

#include "shader_code.h"

namespace pcl_bv::detail {
namespace {

struct ShaderLayout {
  ShaderCode code;
  std::uint32_t buffers;
  std::uint32_t push_bytes;
};

ShaderLayout layout_of(Shader shader) {
  switch (shader) {
    case Shader::extremes:
      return {extremes_code(), 3, 24};
    case Shader::cloud_keys:
      return {cloud_keys_code(), 2, 4};
    case Shader::candidates:
      return {candidates_code(), 3, 20};
    case Shader::near_points:
      return {near_points_code(), 4, 32};
    case Shader::clusters:
      return {clusters_code(), 5, 20};
    case Shader::distances:
      return {distances_code(), 2, 44};
    case Shader::morton:
      return {morton_code(), 3, 56};
    case Shader::digit_counts:
      return {digit_counts_code(), 2, 16};
    case Shader::digit_sums:
      return {digit_sums_code(), 1, 4};
    case Shader::scatter:
      return {scatter_code(), 5, 16};
    case Shader::packets:
      return {packets_code(), 5, 20};
    case Shader::levels:
      return {levels_code(), 1, 12};
    default:
      return {queries_code(), 5, 44};
  }
}

}  // namespace

ComputePipeline::ComputePipeline(GpuContext& context, Shader shader,
                                 const std::vector<std::uint32_t>& constants)
    : context_(context) {
  try {
    make(shader, constants);
  } catch (...) {
    destroy();
    throw;
  }
}

ComputePipeline::~ComputePipeline() {
  destroy();
}

void ComputePipeline::make(Shader shader, const std::vector<std::uint32_t>& constants) {
  const VulkanApi& vk = context_.vk;
  const ShaderLayout layout_info = layout_of(shader);
  std::vector<VkDescriptorSetLayoutBinding> buffers(layout_info.buffers);
  for (std::uint32_t i = 0; i < layout_info.buffers; ++i)
    buffers[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  auto set =
      vulkan_struct<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  set.bindingCount = layout_info.buffers;
  set.pBindings = buffers.data();
  context_.check(vk.vkCreateDescriptorSetLayout(context_.device, &set, nullptr, &bindings), "make a layout");

  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, layout_info.push_bytes};
  auto made = vulkan_struct<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  made.setLayoutCount = 1;
  made.pSetLayouts = &bindings;
  made.pushConstantRangeCount = 1;
  made.pPushConstantRanges = &push;
  context_.check(vk.vkCreatePipelineLayout(context_.device, &made, nullptr, &layout), "make a layout");

  auto code = vulkan_struct<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
  code.codeSize = layout_info.code.bytes;
  code.pCode = layout_info.code.words;
  VkShaderModule module = VK_NULL_HANDLE;
  context_.check(vk.vkCreateShaderModule(context_.device, &code, nullptr, &module), "load a shader");

  std::vector<VkSpecializationMapEntry> entries;
  for (std::uint32_t i = 0; i < constants.size(); ++i)
    entries.push_back({i, 4 * i, 4});
  const VkSpecializationInfo special{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                     4 * constants.size(), constants.data()};
  auto compute = vulkan_struct<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  compute.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  compute.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  compute.stage.module = module;
  compute.stage.pName = "main";
  compute.stage.pSpecializationInfo = &special;
  compute.layout = layout;
  const VkResult result =
      vk.vkCreateComputePipelines(context_.device, VK_NULL_HANDLE, 1, &compute, nullptr, &pipeline);
  vk.vkDestroyShaderModule(context_.device, module, nullptr);
  context_.check(result, "compile a shader");
}

void ComputePipeline::destroy() {
  const VulkanApi& vk = context_.vk;
  vk.vkDestroyPipeline(context_.device, pipeline, nullptr);
  vk.vkDestroyPipelineLayout(context_.device, layout, nullptr);
  vk.vkDestroyDescriptorSetLayout(context_.device, bindings, nullptr);
}

}  // namespace pcl_bv::detail
