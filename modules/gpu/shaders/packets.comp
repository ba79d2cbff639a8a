// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Gathers points in the order of a tree, 16 to a packet, and finds the box around each packet. A workgroup
// has the 16 packets of one group of boxes. Points that are not valid get the number kNone.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "boxes.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kStride = 3;  // words from one point to the next

layout(std430, binding = 0) readonly buffer Points { uint words[]; };
layout(std430, binding = 1) readonly buffer Order { uint order[]; };
layout(std430, binding = 2) writeonly buffer Packets { uint packets[]; };  // [packet][axis][point]
layout(std430, binding = 3) writeonly buffer Numbers { uint numbers[]; };  // [packet][point]
layout(std430, binding = 4) writeonly buffer Boxes { float boxes[]; };     // [group][low x, y, z, high][box]
layout(push_constant) uniform Part {
  float center_x, center_y, center_z;
  uint first_word;  // of the first point in `words`
  uint points;
};

const uint kGroupPoints = kWidth * kWidth;

shared float coordinates[3 * kGroupPoints];
shared bool valid[kGroupPoints];

void gather(uint slot) {
  const uint position = gl_WorkGroupID.x * kGroupPoints + slot;
  uvec3 bits = uvec3(0x7fc00000u);
  uint number = kNone;
  if (position < points) {
    number = order[position];
    const uint word = first_word + number * kStride;
    bits = uvec3(words[word], words[word + 1], words[word + 2]);
    if (any(greaterThanEqual(bits & 0x7fffffffu, uvec3(0x7f800000u)))) number = kNone;
  }
  const uint packet = position / kWidth, lane = position % kWidth;
  const float center[3] = float[3](center_x, center_y, center_z);
  for (uint axis = 0; axis < 3; ++axis) {
    packets[(packet * 3 + axis) * kWidth + lane] = bits[axis];
    precise const float relative = uintBitsToFloat(bits[axis]) - center[axis];
    coordinates[axis * kGroupPoints + slot] = relative;
  }
  numbers[position] = number;
  valid[slot] = number != kNone;
}

void main() {
  for (uint slot = gl_LocalInvocationIndex; slot < kGroupPoints; slot += 64)
    gather(slot);
  barrier();
  // A thread finds the extremes of one packet along one axis.
  const uint axis = gl_LocalInvocationIndex / kWidth, box = gl_LocalInvocationIndex % kWidth;
  if (axis >= 3) return;
  float low = kFar, high = -kFar;
  for (uint slot = box * kWidth; slot < (box + 1) * kWidth; ++slot) {
    if (!valid[slot]) continue;
    low = min(low, coordinates[axis * kGroupPoints + slot]);
    high = max(high, coordinates[axis * kGroupPoints + slot]);
  }
  boxes[box_word(gl_WorkGroupID.x, axis, box)] = low;
  boxes[box_word(gl_WorkGroupID.x, axis + 3, box)] = high;
}
