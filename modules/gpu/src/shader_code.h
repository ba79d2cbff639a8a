// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The compiled shaders. The build compiles modules/gpu/shaders/NAME.comp to SPIR-V and writes NAME_code().
#pragma once

#include <cstddef>
#include <cstdint>

namespace pcl_bv::detail {

struct ShaderCode {
  const std::uint32_t* words;
  std::size_t bytes;
};

ShaderCode extremes_code();
ShaderCode cloud_keys_code();
ShaderCode candidates_code();
ShaderCode near_points_code();
ShaderCode clusters_code();
ShaderCode distances_code();
ShaderCode morton_code();
ShaderCode digit_counts_code();
ShaderCode digit_sums_code();
ShaderCode scatter_code();
ShaderCode packets_code();
ShaderCode levels_code();
ShaderCode queries_code();

}  // namespace pcl_bv::detail
