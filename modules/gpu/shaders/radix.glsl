// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Shared by the three steps of a pass of radix sort.

const uint kThreads = 64;
const uint kDigits = 16;
const uint kTile = 512;  // keys that a workgroup sorts at a time

uint digit_of(uint key, uint shift) {
  return (key >> shift) & (kDigits - 1u);
}

shared uint thread_sums[kThreads];

// Returns the sum of `value` over the threads before this one. All threads of the workgroup must call it.
uint sum_before(uint value) {
  const uint thread = gl_LocalInvocationIndex;
  barrier();
  thread_sums[thread] = value;
  for (uint step = 1; step < kThreads; step *= 2) {
    barrier();
    const uint below = thread >= step ? thread_sums[thread - step] : 0;
    barrier();
    thread_sums[thread] += below;
  }
  return thread_sums[thread] - value;
}
