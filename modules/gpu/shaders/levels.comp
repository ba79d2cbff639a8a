// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the boxes of one level of a tree: each contains the 16 boxes of a group of the level below. A
// workgroup makes one group.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "boxes.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) buffer Boxes { float boxes[]; };
layout(push_constant) uniform Level {
  uint first_below;  // number of the first group of the level below
  uint below;        // number of its groups
  uint first;        // number of the first group of this level
};

void main() {
  for (uint task = gl_LocalInvocationIndex; task < 6 * kWidth; task += 64) {
    const uint side = task / kWidth, box = task % kWidth;
    const uint group = gl_WorkGroupID.x * kWidth + box;
    float extreme = side < 3 ? kFar : -kFar;
    if (group < below) {
      for (uint child = 0; child < kWidth; ++child) {
        const float value = boxes[box_word(first_below + group, side, child)];
        extreme = side < 3 ? min(extreme, value) : max(extreme, value);
      }
    }
    boxes[box_word(first + gl_WorkGroupID.x, side, box)] = extreme;
  }
}
