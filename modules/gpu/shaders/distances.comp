// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Lists the blocks that have a point far from a centre, one workgroup per block. docs/numerics.md bounds the
// error of the distances, which the limit includes.
#version 450

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kStride = 3;  // words from one point to the next

layout(std430, binding = 0) readonly buffer Points { uint words[]; };
layout(std430, binding = 1) buffer Blocks {
  uint listed;
  uint numbers[];
};
layout(push_constant) uniform Part {
  float center_x, center_y, center_z;  // the centre, rounded to float
  float rest_x, rest_y, rest_z;        // what rounding has removed from it
  float limit;                         // blocks whose squared distances are all below this are rejected
  uint first_word;                     // of the first point of this part in `words`
  uint points;                         // number of points of this part
  uint first_block;                    // number of this part's first block in the cloud
  uint capacity;                       // of `numbers`
};

const uint kBlockPoints = 1024;
const uint kThreads = 64;

shared bool far_from_center;

void main() {
  const uint block = gl_WorkGroupID.x;
  if (gl_LocalInvocationIndex == 0) far_from_center = false;
  barrier();
  const uint end = min(kBlockPoints, points - block * kBlockPoints);
  bool found = false;
  for (uint i = gl_LocalInvocationIndex; i < end; i += kThreads) {
    const uint word = first_word + (block * kBlockPoints + i) * kStride;
    const uvec3 bits = uvec3(words[word], words[word + 1], words[word + 2]);
    if (any(greaterThanEqual(bits & 0x7fffffffu, uvec3(0x7f800000u)))) continue;
    precise const float x = (uintBitsToFloat(bits.x) - center_x) - rest_x;
    precise const float y = (uintBitsToFloat(bits.y) - center_y) - rest_y;
    precise const float z = (uintBitsToFloat(bits.z) - center_z) - rest_z;
    found = found || !(x * x + y * y + z * z < limit);
  }
  if (found) far_from_center = true;
  barrier();
  if (gl_LocalInvocationIndex != 0 || !far_from_center) return;
  const uint slot = atomicAdd(listed, 1);
  if (slot < capacity) numbers[slot] = first_block + block;
}
