// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the extremes of blocks of 1024 points along the directions of a k-DOP, one workgroup per block.
// Projections are those of p - center in float; docs/numerics.md bounds their error. Along the axes, the keys
// are those of the coordinates themselves, without any arithmetic.
#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "float_keys.glsl"
#include "supports.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 1) const uint kStride = 3;  // words from one point to the next

layout(std430, binding = 0) readonly buffer Points { uint words[]; };
// The key of support s of block b is keys[b * kSupports + s].
layout(std430, binding = 1) writeonly buffer BlockKeys { int block_keys[]; };
layout(std430, binding = 2) buffer Cloud {
  int cloud_keys[26];
  uint dropped;
  uint listed;
  uint listed_points;
};
layout(push_constant) uniform Part {
  float center_x, center_y, center_z;
  uint first_word;   // of the first point of this part in `words`
  uint points;       // number of points of this part
  uint first_block;  // number of this part's first block in the cloud
};

const uint kThreads = 64;
const uint kRow = kThreads + 1;  // a stride by which threads that read one column each use different banks
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

// Extremes of the bits of coordinates, as signed and as unsigned integers. They determine the lowest and the
// highest coordinate with three operations for each point, where keys take eight.
struct Bits {
  int low, high;
  uint highest;
};

void include(inout Bits range, uint bits) {
  range.low = min(range.low, int(bits));
  range.high = max(range.high, int(bits));
  range.highest = max(range.highest, bits);
}

// Returns the keys of the lowest and the highest coordinate. If there are negative floats, the largest unsigned
// integer is the lowest float. If all are negative, the smallest signed integer is the highest float.
ivec2 keys_of(Bits range) {
  const uint low = int(range.highest) < 0 ? range.highest : uint(range.low);
  const uint high = range.high >= 0 ? uint(range.high) : uint(range.low);
  return ivec2(~key_of(without_negative_zero(low)), key_of(without_negative_zero(high)));
}

void store(uint support, ivec2 keys) {
  thread_keys[support * kRow + gl_LocalInvocationIndex] = keys.x;
  thread_keys[(support + 1) * kRow + gl_LocalInvocationIndex] = keys.y;
}

void store(uint support, Range range, bool any) {
  const int low = key_of(floatBitsToUint(range.low)), high = key_of(floatBitsToUint(range.high));
  store(support, any ? ivec2(~low, high) : ivec2(kNoKey));
}

void store(uint support, Bits range, bool any) {
  store(support, any ? keys_of(range) : ivec2(kNoKey));
}

const Bits kNoBits = Bits(0x7fffffff, kNoKey, 0u);
const Range kNoRange = Range(kLargest, -kLargest);

// The extremes of this thread's points.
Bits x_bits = kNoBits, y_bits = kNoBits, z_bits = kNoBits;
Range corners[4] = Range[](kNoRange, kNoRange, kNoRange, kNoRange);
Range edges[6] = Range[](kNoRange, kNoRange, kNoRange, kNoRange, kNoRange, kNoRange);

void include_point(uvec3 bits) {
  include(x_bits, bits.x);
  include(y_bits, bits.y);
  include(z_bits, bits.z);
  if (kSet == 0) return;
  const Projections projections = project(bits, vec3(center_x, center_y, center_z));
  [[unroll]] for (uint k = 0; kCorners && k < 4; ++k)
    include(corners[k], projections.corners[k]);
  [[unroll]] for (uint k = 0; kEdges && k < 6; ++k)
    include(edges[k], projections.edges[k]);
}

void store_extremes() {
  const bool any_valid = x_bits.low != kNoBits.low;  // 0x7fffffff is a NaN, which is_valid() rejects
  store(0, x_bits, any_valid);
  store(2, y_bits, any_valid);
  store(4, z_bits, any_valid);
  [[unroll]] for (uint k = 0; kCorners && k < 4; ++k)
    store(kCornerSupport + 2 * k, corners[k], any_valid);
  [[unroll]] for (uint k = 0; kEdges && k < 6; ++k)
    store(kEdgeSupport + 2 * k, edges[k], any_valid);
}

// Returns the largest of a support's keys. Two threads reduce each support.
int reduced_key() {
  const uint support = gl_LocalInvocationIndex / 2;
  const uint first = support * kRow + gl_LocalInvocationIndex % 2 * (kThreads / 2);
  int key = kNoKey;
  if (support < kSupports) {
    for (uint i = 0; i < kThreads / 2; ++i)
      key = max(key, thread_keys[first + i]);
  }
  barrier();
  thread_keys[gl_LocalInvocationIndex] = key;
  barrier();
  const uint pair = 2 * gl_LocalInvocationIndex;
  return pair < kThreads ? max(thread_keys[pair], thread_keys[pair + 1]) : kNoKey;
}

void main() {
  const uint block = gl_WorkGroupID.x;
  if (gl_LocalInvocationIndex == 0) block_dropped = 0;
  const uint end = min(kBlockPoints, points - block * kBlockPoints);
  // All points of a thread are loaded before the first one is used: the card then waits for memory once.
  uvec3 loaded[kBlockPoints / kThreads];
  [[unroll]] for (uint k = 0; k < kBlockPoints / kThreads; ++k) {
    // Beyond the end, the last point is read again, which changes no extreme.
    const uint point = block * kBlockPoints + min(k * kThreads + gl_LocalInvocationIndex, end - 1);
    const uint word = first_word + point * kStride;
    loaded[k] = uvec3(words[word], words[word + 1], words[word + 2]);
  }
  uint bad = 0;
  [[unroll]] for (uint k = 0; k < kBlockPoints / kThreads; ++k) {
    if (is_valid(loaded[k])) include_point(loaded[k]);
    else if (k * kThreads + gl_LocalInvocationIndex < end) ++bad;
  }
  store_extremes();
  barrier();
  if (bad > 0) atomicAdd(block_dropped, bad);
  const int key = reduced_key();
  if (gl_LocalInvocationIndex < kSupports)
    block_keys[(first_block + block) * kSupports + gl_LocalInvocationIndex] = key;
  if (gl_LocalInvocationIndex == 0 && block_dropped > 0) atomicAdd(dropped, block_dropped);
}
