// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Lists the blocks that can have a support point, one thread per block: those with a key at or above the limit
// of that support.
#version 450
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
layout(std430, binding = 2) writeonly buffer Blocks { uint candidates[]; };
layout(push_constant) uniform Limits {
  float center_x, center_y, center_z;
  uint blocks;    // number of blocks of the cloud
  uint capacity;  // of `candidates`
};

#include "limits.glsl"

shared int limits[kSupports];

void main() {
  if (gl_LocalInvocationIndex < kSupports)
    limits[gl_LocalInvocationIndex] = limit_of(gl_LocalInvocationIndex, vec3(center_x, center_y, center_z));
  barrier();
  const uint block = gl_GlobalInvocationID.x;
  if (block >= blocks || block_keys[block * kSupports] == kNoKey) return;  // outside, or no valid point
  bool found = false;
  for (uint support = 0; support < kSupports; ++support)
    found = found || block_keys[block * kSupports + support] >= limits[support];
  if (!found) return;
  const uint slot = atomicAdd(listed, 1);
  if (slot < capacity) candidates[slot] = block;
}
