// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Lists the points of listed blocks that can be a support point: those with a key at or above the limit of that
// support. Workgroup g processes entries g, g + gl_NumWorkGroups.x, ... of the list of blocks.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "float_keys.glsl"
#include "supports.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 1) const uint kStride = 3;  // words from one point to the next

layout(std430, binding = 0) readonly buffer Points { uint words[]; };
layout(std430, binding = 1) buffer Cloud {
  int cloud_keys[26];
  uint dropped;
  uint listed;
  uint listed_points;
};
layout(std430, binding = 2) readonly buffer Blocks { uint candidates[]; };
layout(std430, binding = 3) writeonly buffer NearPoints { uint near_points[]; };
layout(push_constant) uniform Part {
  float center_x, center_y, center_z;
  uint first_word;       // of the first point of this part in `words`
  uint points;           // number of points of this part
  uint first_block;      // number of this part's first block in the cloud
  uint capacity;         // of `candidates`
  uint points_capacity;  // of `near_points`
};

#include "limits.glsl"

shared int limits[kSupports];

bool is_within_limit(uint support, int low_key, int high_key) {
  return ~low_key >= limits[support] || high_key >= limits[support + 1];
}

bool is_within_limit(uint support, float projection) {
  const int key = key_of(floatBitsToUint(projection));
  return is_within_limit(support, key, key);
}

bool is_near(uvec3 bits) {
  if (!is_valid(bits)) return false;
  bool near = false;
  for (uint axis = 0; axis < 3; ++axis) {
    const int key = key_of(without_negative_zero(bits[axis]));
    near = near || is_within_limit(2 * axis, key, key);
  }
  const Projections projections = project(bits, vec3(center_x, center_y, center_z));
  for (uint k = 0; kCorners && k < 4; ++k)
    near = near || is_within_limit(kCornerSupport + 2 * k, projections.corners[k]);
  for (uint k = 0; kEdges && k < 6; ++k)
    near = near || is_within_limit(kEdgeSupport + 2 * k, projections.edges[k]);
  return near;
}

void main() {
  if (gl_LocalInvocationIndex < kSupports)
    limits[gl_LocalInvocationIndex] = limit_of(gl_LocalInvocationIndex, vec3(center_x, center_y, center_z));
  barrier();
  for (uint i = gl_WorkGroupID.x; i < min(listed, capacity); i += gl_NumWorkGroups.x) {
    const uint block = candidates[i] - first_block;  // a large number if it is in an earlier part
    if (block >= (points + kBlockPoints - 1) / kBlockPoints) continue;
    const uint end = min((block + 1) * kBlockPoints, points);
    for (uint point = block * kBlockPoints + gl_LocalInvocationIndex; point < end; point += 64) {
      const uint word = first_word + point * kStride;
      if (!is_near(uvec3(words[word], words[word + 1], words[word + 2]))) continue;
      const uint slot = atomicAdd(listed_points, 1);
      if (slot < points_capacity) near_points[slot] = first_block * kBlockPoints + point;
    }
  }
}
