// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Lists the blocks that can have a support point, one thread per block. A block is listed if one of its
// extremes is within the error band of the cloud's extreme. docs/numerics.md proves that every support point
// is in a listed block.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "float_keys.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kSet = 3;  // as in extremes.comp

layout(std430, binding = 0) readonly buffer BlockKeys { int block_keys[]; };
layout(std430, binding = 1) buffer Cloud {
  int cloud_keys[26];
  uint dropped;
  uint listed;
};
layout(std430, binding = 2) writeonly buffer Blocks { uint candidates[]; };
layout(push_constant) uniform Limits {
  float center_x, center_y, center_z;
  uint blocks;    // number of blocks of the cloud
  uint capacity;  // of `candidates`
};

const bool kCorners = kSet == 1 || kSet == 3;
const bool kEdges = kSet >= 2;
const uint kEdgeSupport = kCorners ? 14 : 6;

// The largest magnitude of p - center along an axis.
float magnitude(uint axis, float center) {
  precise const float low = float_of(~cloud_keys[2 * axis]) - center;
  precise const float high = float_of(cloud_keys[2 * axis + 1]) - center;
  return max(abs(low), abs(high));
}

// Whether this block's key is within `band` of the cloud's. A NaN or an overflow lists the block; the host
// notices magnitudes for which this can happen, and does not use the list.
bool near(uint block, uint support, float band) {
  const int key = cloud_keys[support];
  const bool low = (support & 1u) == 0;
  precise const float extreme = float_of(low ? ~key : key);
  precise const float limit = low ? extreme + band : extreme - band;
  const int limit_key = key_of(floatBitsToUint(limit));
  return block_keys[support * blocks + block] >= (low ? ~limit_key : limit_key);
}

bool near_either(uint block, uint support, float band) {
  return near(block, support, band) || near(block, support + 1, band);
}

// The band for projections whose terms have magnitudes of at most `sum` together: 2^-19 of it, and 2^-120 for
// denormal numbers that the device may replace by 0.
float band(float sum) {
  precise const float relative = sum * 1.9073486328125e-6;
  precise const float result = relative + 7.5231638452626401e-37;
  return result;
}

// Along the axes the device has the coordinates themselves, or differences whose rounding keeps their order.
bool exactly_near(uint block, uint support) {
  return block_keys[support * blocks + block] >= cloud_keys[support];
}

void main() {
  const uint block = gl_GlobalInvocationID.x;
  if (block >= blocks || block_keys[block] == kNoKey) return;  // outside, or no valid point
  const float x = magnitude(0, center_x), y = magnitude(1, center_y), z = magnitude(2, center_z);
  bool found = false;
  for (uint support = 0; support < 6; ++support)
    found = found || exactly_near(block, support);
  if (kCorners) {
    const float all = band(x + y + z);
    for (uint support = 6; support < 14; support += 2)
      found = found || near_either(block, support, all);
  }
  if (kEdges) {
    const float xy = band(x + y), xz = band(x + z), yz = band(y + z);
    found = found || near_either(block, kEdgeSupport, xy) || near_either(block, kEdgeSupport + 2, xy) ||
            near_either(block, kEdgeSupport + 4, xz) || near_either(block, kEdgeSupport + 6, xz) ||
            near_either(block, kEdgeSupport + 8, yz) || near_either(block, kEdgeSupport + 10, yz);
  }
  if (!found) return;
  const uint slot = atomicAdd(listed, 1);
  if (slot < capacity) candidates[slot] = block;
}
