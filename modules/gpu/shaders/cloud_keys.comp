// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the extremes of a cloud from those of its blocks. A workgroup reduces 256 blocks.
#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "float_keys.glsl"
#include "supports.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer BlockKeys { int block_keys[]; };
layout(std430, binding = 1) buffer Cloud {
  int cloud_keys[26];
  uint dropped;
  uint listed;
  uint listed_points;
};
layout(push_constant) uniform Blocks { uint blocks; };

const uint kSupportThreads = 32;  // one thread per support in each row; the last ones are idle
const uint kRows = 64 / kSupportThreads;
const uint kBatch = 8;
const uint kGroupBlocks = 256;

shared int row_keys[64];

void main() {
  const uint support = gl_LocalInvocationIndex % kSupportThreads, row = gl_LocalInvocationIndex / kSupportThreads;
  const uint first = gl_WorkGroupID.x * kGroupBlocks;
  int key = kNoKey;
  if (support < kSupports) {
    for (uint batch = first + row; batch < min(first + kGroupBlocks, blocks); batch += kBatch * kRows) {
      [[unroll]] for (uint k = 0; k < kBatch; ++k) {
        const uint block = min(batch + k * kRows, blocks - 1);
        key = max(key, block_keys[block * kSupports + support]);
      }
    }
  }
  row_keys[gl_LocalInvocationIndex] = key;
  barrier();
  if (gl_LocalInvocationIndex < kSupports)
    atomicMax(cloud_keys[support], max(key, row_keys[gl_LocalInvocationIndex + kSupportThreads]));
}
