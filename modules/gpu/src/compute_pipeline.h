// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <vector>

#include "gpu_context.h"

namespace pcl_bv::detail {

/// The shaders in modules/gpu/shaders.
enum class Shader : std::uint8_t {
  extremes,      ///< extremes.comp: the extremes of each block.
  cloud_keys,    ///< cloud_keys.comp: the extremes of the cloud.
  candidates,    ///< candidates.comp: lists the blocks that can have a support.
  near_points,   ///< near_points.comp: lists the points of those blocks that can be a support.
  clusters,      ///< clusters.comp: the slabs of clusters.
  distances,     ///< distances.comp: lists the blocks with points far from a centre.
  morton,        ///< morton.comp: sort keys of points.
  digit_counts,  ///< digit_counts.comp, digit_sums.comp, scatter.comp: a pass of radix sort.
  digit_sums,
  scatter,
  packets,  ///< packets.comp: the points of a tree, and the boxes around them.
  levels,   ///< levels.comp: boxes around the boxes of the level below.
  queries   ///< queries.comp: candidates for the results of queries.
};

/// Threads of a workgroup in every shader.
inline constexpr std::uint32_t kWorkgroup = 64;

/// A shader with its layout: storage buffers from binding 0 on, and push constants.
class ComputePipeline {
 public:
  /// `constants` are the specialization constants from number 0 on. Throws GpuError.
  ComputePipeline(GpuContext& context, Shader shader, const std::vector<std::uint32_t>& constants);
  ~ComputePipeline();
  ComputePipeline(const ComputePipeline&) = delete;
  ComputePipeline& operator=(const ComputePipeline&) = delete;

  VkPipeline pipeline = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkDescriptorSetLayout bindings = VK_NULL_HANDLE;

 private:
  void make(Shader shader, const std::vector<std::uint32_t>& constants);
  void destroy();

  GpuContext& context_;
};

}  // namespace pcl_bv::detail
