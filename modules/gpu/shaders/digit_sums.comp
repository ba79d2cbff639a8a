// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Second step of a pass of radix sort: replaces each count by the sum of the counts before it. One workgroup.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "radix.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) buffer Counts { uint counts[]; };
layout(push_constant) uniform Pass {
  uint size;  // of `counts`
};

void main() {
  const uint each = (size + kThreads - 1) / kThreads;
  const uint begin = min(size, gl_LocalInvocationIndex * each), end = min(size, begin + each);
  uint sum = 0;
  for (uint i = begin; i < end; ++i)
    sum += counts[i];
  uint before = sum_before(sum);
  for (uint i = begin; i < end; ++i) {
    const uint own = counts[i];
    counts[i] = before;
    before += own;
  }
}
