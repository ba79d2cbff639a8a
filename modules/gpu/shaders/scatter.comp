// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Third step of a pass of radix sort: moves keys and numbers to the places of their digits, without a change
// of order within a digit. A workgroup sorts its run tile by tile in shared memory, so that it writes the
// keys of a digit in consecutive slots.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "radix.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Keys { uint keys[]; };
layout(std430, binding = 1) readonly buffer Numbers { uint numbers[]; };
layout(std430, binding = 2) readonly buffer Begins { uint begins[]; };  // [digit][run]
layout(std430, binding = 3) writeonly buffer KeysOut { uint keys_out[]; };
layout(std430, binding = 4) writeonly buffer NumbersOut { uint numbers_out[]; };
layout(push_constant) uniform Pass {
  uint count;  // of keys
  uint run;    // keys of a run, a multiple of kTile
  uint runs;
  uint shift;  // of the digit in the key
};

const uint kEach = kTile / kThreads;  // consecutive keys of a thread

shared uint tile_keys[kTile + kThreads];  // a gap after the keys of each thread avoids conflicts of banks
shared uint sorted_keys[kTile], sorted_numbers[kTile];
shared uint ranks[kDigits * kThreads];  // [digit][thread]
shared uint next_output[kDigits];        // where the next key of a digit goes, in the output
shared uint first_rank[kDigits];        // of a digit in the tile

uint gap(uint i) {
  return i + i / kEach;
}

// Writes the sums before each entry of `ranks`.
void sum_ranks() {
  // Each thread adds up as many entries as there are digits, because there are kDigits * kThreads entries.
  const uint begin = gl_LocalInvocationIndex * kDigits;
  uint sum = 0;
  for (uint i = begin; i < begin + kDigits; ++i)
    sum += ranks[i];
  uint before = sum_before(sum);
  for (uint i = begin; i < begin + kDigits; ++i) {
    const uint own = ranks[i];
    ranks[i] = before;
    before += own;
  }
}

void sort_tile(uint begin, uint size) {
  const uint thread = gl_LocalInvocationIndex;
  for (uint i = thread; i < size; i += kThreads)
    tile_keys[gap(i)] = keys[begin + i];
  for (uint digit = 0; digit < kDigits; ++digit)
    ranks[digit * kThreads + thread] = 0;
  barrier();
  const uint first = thread * kEach, last = min(size, first + kEach);
  for (uint i = first; i < last; ++i)
    ++ranks[digit_of(tile_keys[gap(i)], shift) * kThreads + thread];
  barrier();
  sum_ranks();
  barrier();
  if (thread < kDigits) first_rank[thread] = ranks[thread * kThreads];
  barrier();
  for (uint i = first; i < last; ++i) {
    const uint key = tile_keys[gap(i)];
    const uint rank = ranks[digit_of(key, shift) * kThreads + thread]++;
    sorted_keys[rank] = key;
    sorted_numbers[rank] = numbers[begin + i];
  }
  barrier();
}

void write_tile(uint size) {
  const uint thread = gl_LocalInvocationIndex;
  for (uint rank = thread; rank < size; rank += kThreads) {
    const uint key = sorted_keys[rank], digit = digit_of(key, shift);
    const uint output_slot = next_output[digit] + (rank - first_rank[digit]);
    keys_out[output_slot] = key;
    numbers_out[output_slot] = sorted_numbers[rank];
  }
  barrier();
  if (thread < kDigits) {
    const uint end = thread + 1 < kDigits ? first_rank[thread + 1] : size;
    next_output[thread] += end - first_rank[thread];
  }
  barrier();
}

void main() {
  if (gl_LocalInvocationIndex < kDigits)
    next_output[gl_LocalInvocationIndex] = begins[gl_LocalInvocationIndex * runs + gl_WorkGroupID.x];
  const uint begin = gl_WorkGroupID.x * run, end = min(count, begin + run);
  for (uint tile = begin; tile < end; tile += kTile) {
    const uint size = min(kTile, end - tile);
    sort_tile(tile, size);
    write_tile(size);
  }
}
