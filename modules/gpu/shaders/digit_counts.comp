// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// First step of a pass of radix sort (Satish, Harris, Garland 2009): counts the keys of each digit in each
// run. A workgroup has one run.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "radix.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Keys { uint keys[]; };
layout(std430, binding = 1) writeonly buffer Counts { uint counts[]; };  // [digit][run]
layout(push_constant) uniform Pass {
  uint count;  // of keys
  uint run;    // keys of a run, a multiple of kTile
  uint runs;
  uint shift;  // of the digit in the key
};

shared uint of_thread[kDigits * kThreads];

void main() {
  const uint thread = gl_LocalInvocationIndex;
  for (uint digit = 0; digit < kDigits; ++digit)
    of_thread[digit * kThreads + thread] = 0;
  const uint begin = gl_WorkGroupID.x * run, end = min(count, begin + run);
  for (uint i = begin + thread; i < end; i += kThreads)
    ++of_thread[digit_of(keys[i], shift) * kThreads + thread];
  barrier();
  if (thread >= kDigits) return;
  uint sum = 0;
  for (uint t = 0; t < kThreads; ++t)
    sum += of_thread[thread * kThreads + t];
  counts[thread * runs + gl_WorkGroupID.x] = sum;
}
