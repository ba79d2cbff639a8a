// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the extremes of blocks of 1024 points along the directions of a k-DOP, one workgroup per block, and
// the extremes of the cloud. Projections are those of p - center in float; docs/numerics.md bounds their
// error. Along the axes, the keys are those of the coordinates themselves, without any arithmetic.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "float_keys.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kSet = 3;     // directions: 0 axes, 1 dop14, 2 dop18, 3 dop26
layout(constant_id = 1) const uint kStride = 3;  // words from one point to the next

layout(std430, binding = 0) readonly buffer Points { uint words[]; };
// The key of support s of block b is keys[s * blocks + b]. Support 2k is the minimum along direction k,
// support 2k + 1 the maximum. The key of a minimum is inverted, so that of all keys the largest counts.
layout(std430, binding = 1) writeonly buffer BlockKeys { int block_keys[]; };
layout(std430, binding = 2) coherent buffer Cloud {
  int cloud_keys[26];
  uint dropped;
  uint listed;
};
layout(push_constant) uniform Part {
  float center_x, center_y, center_z;
  uint first_word;   // of the first point of this part in `words`
  uint points;       // number of points of this part
  uint first_block;  // number of this part's first block in the cloud
  uint blocks;       // number of blocks of the cloud
};

const uint kBlockPoints = 1024;
const uint kThreads = 64;
const uint kRow = kThreads + 1;  // a stride by which threads that read one column each use different banks
const bool kCorners = kSet == 1 || kSet == 3;
const bool kEdges = kSet >= 2;
const uint kCornerSupport = 6;
const uint kEdgeSupport = kCorners ? 14 : 6;
const uint kSupports = 6 + (kCorners ? 8 : 0) + (kEdges ? 12 : 0);
const float kLargest = 3.402823466e38;

shared int thread_keys[kSupports * kRow];
shared uint block_dropped;

struct Range {
  float low, high;
};

void include(inout Range range, float value) {
  range.low = min(range.low, value);
  range.high = max(range.high, value);
}

void include(inout ivec2 keys, uint bits) {
  const int key = key_of(bits == 0x80000000u ? 0u : bits);  // -0 and 0 are equal coordinates
  keys = ivec2(max(keys.x, ~key), max(keys.y, key));
}

void store(uint support, ivec2 keys) {
  thread_keys[support * kRow + gl_LocalInvocationIndex] = keys.x;
  thread_keys[(support + 1) * kRow + gl_LocalInvocationIndex] = keys.y;
}

void store(uint support, Range range, bool any) {
  const int low = key_of(floatBitsToUint(range.low)), high = key_of(floatBitsToUint(range.high));
  store(support, any ? ivec2(~low, high) : ivec2(kNoKey));
}

void main() {
  const uint block = gl_WorkGroupID.x;
  ivec2 x_keys = ivec2(kNoKey), y_keys = x_keys, z_keys = x_keys;
  const Range none = Range(kLargest, -kLargest);
  Range c0 = none, c1 = none, c2 = none, c3 = none;                      // corners
  Range e0 = none, e1 = none, e2 = none, e3 = none, e4 = none, e5 = none;  // edges
  uint bad = 0;
  if (gl_LocalInvocationIndex == 0) block_dropped = 0;
  const uint end = min(kBlockPoints, points - block * kBlockPoints);
  for (uint i = gl_LocalInvocationIndex; i < end; i += kThreads) {
    const uint word = first_word + (block * kBlockPoints + i) * kStride;
    const uvec3 bits = uvec3(words[word], words[word + 1], words[word + 2]);
    if (any(greaterThanEqual(bits & 0x7fffffffu, uvec3(0x7f800000u)))) {
      ++bad;
      continue;
    }
    include(x_keys, bits.x);
    include(y_keys, bits.y);
    include(z_keys, bits.z);
    if (kSet == 0) continue;
    precise const float x = uintBitsToFloat(bits.x) - center_x;
    precise const float y = uintBitsToFloat(bits.y) - center_y;
    precise const float z = uintBitsToFloat(bits.z) - center_z;
    precise const float sum = x + y, difference = x - y;
    if (kCorners) {
      precise const float s0 = sum + z, s1 = sum - z, s2 = difference + z, s3 = difference - z;
      include(c0, s0);
      include(c1, s1);
      include(c2, s2);
      include(c3, s3);
    }
    if (kEdges) {
      precise const float s2 = x + z, s3 = x - z, s4 = y + z, s5 = y - z;
      include(e0, sum);
      include(e1, difference);
      include(e2, s2);
      include(e3, s3);
      include(e4, s4);
      include(e5, s5);
    }
  }
  const bool any_valid = x_keys.x != kNoKey;
  store(0, x_keys);
  store(2, y_keys);
  store(4, z_keys);
  if (kCorners) {
    store(kCornerSupport, c0, any_valid);
    store(kCornerSupport + 2, c1, any_valid);
    store(kCornerSupport + 4, c2, any_valid);
    store(kCornerSupport + 6, c3, any_valid);
  }
  if (kEdges) {
    store(kEdgeSupport, e0, any_valid);
    store(kEdgeSupport + 2, e1, any_valid);
    store(kEdgeSupport + 4, e2, any_valid);
    store(kEdgeSupport + 6, e3, any_valid);
    store(kEdgeSupport + 8, e4, any_valid);
    store(kEdgeSupport + 10, e5, any_valid);
  }
  barrier();
  if (bad > 0) atomicAdd(block_dropped, bad);
  if (gl_LocalInvocationIndex < kSupports) {
    const uint support = gl_LocalInvocationIndex;
    int key = kNoKey;
    for (uint thread = 0; thread < kThreads; ++thread)
      key = max(key, thread_keys[support * kRow + thread]);
    block_keys[support * blocks + first_block + block] = key;
    // Nearly all blocks are inside the extremes of the blocks before them, so few atomic operations are
    // needed.
    if (key > cloud_keys[support]) atomicMax(cloud_keys[support], key);
  }
  barrier();
  if (gl_LocalInvocationIndex == 0 && block_dropped > 0) atomicAdd(dropped, block_dropped);
}
