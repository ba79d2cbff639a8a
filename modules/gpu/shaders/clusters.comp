// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Computes the slabs of clusters, one workgroup per cluster, exactly: coordinates are integers in a unit of
// the cluster. A cluster is left to the processor if its coordinates have too many different exponents, or if
// it is not clear that it spans three dimensions.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "fixed_point.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kSet = 3;     // directions: 0 axes, 1 dop14, 2 dop18, 3 dop26
layout(constant_id = 1) const uint kStride = 3;  // words from one point to the next
layout(constant_id = 2) const bool kListed = false;  // whether clusters are lists of indices, not ranges

// A cluster begins in the first part of the cloud and can end in the second one.
layout(std430, binding = 0) readonly buffer FirstPart { uint first_words[]; };
layout(std430, binding = 1) readonly buffer SecondPart { uint second_words[]; };
// Where each cluster begins, and where the last one ends: a point or, for lists, a position in `indices`.
layout(std430, binding = 2) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = 3) readonly buffer Indices { uint indices[]; };
// For each cluster: the number of valid points; 1 if the slabs are those of the cluster, which has rank 3,
// else 0; for each direction the minimum and the maximum as doubles, low words first.
layout(std430, binding = 4) writeonly buffer Results { uint results[]; };
layout(push_constant) uniform Slice {
  uint first_word, second_word;  // of the first point of each part
  uint first_point;              // number of the first part's first point
  uint first_count;              // number of points of the first part
  uint first_offset;             // what entries of `indices` are relative to
};

const uint kThreads = 64;
const uint kRow = kThreads + 1;
const bool kCorners = kSet == 1 || kSet == 3;
const bool kEdges = kSet >= 2;
const uint kCornerSlab = 3;
const uint kEdgeSlab = kCorners ? 7 : 3;
const uint kSlabs = 3 + (kCorners ? 4 : 0) + (kEdges ? 6 : 0);
const uint kResultWords = 2 + 4 * kSlabs;

// At most four slabs at a time are reduced: all slabs of all threads would leave a core few workgroups.
const uint kGroup = 4;
shared uvec2 thread_low[kGroup * kRow], thread_high[kGroup * kRow];
shared uvec2 axis_low[3], axis_high[3];
shared int lowest_bit, highest_exponent;
shared uint valid_points;
shared bool solid;

struct Slab {
  uvec2 low, high;
};

struct Point {
  uvec2 x, y, z;
};

uvec3 bits_of(uint position) {
  const uint point = (kListed ? indices[position - first_offset] : position) - first_point;
  if (point < first_count) {
    const uint word = first_word + point * kStride;
    return uvec3(first_words[word], first_words[word + 1], first_words[word + 2]);
  }
  const uint word = second_word + (point - first_count) * kStride;
  return uvec3(second_words[word], second_words[word + 1], second_words[word + 2]);
}

bool is_valid(uvec3 bits) {
  return all(lessThan(bits & 0x7fffffffu, uvec3(0x7f800000u)));
}

void find_exponents(uint bits, inout int low, inout int high) {
  const Parts parts = parts_of(bits);
  if (parts.significand == 0u) return;
  low = min(low, parts.exponent + findLSB(parts.significand));
  high = max(high, parts.exponent + findMSB(parts.significand));
}

void include(inout Slab slab, uvec2 value) {
  if (less(value, slab.low)) slab.low = value;
  if (less(slab.high, value)) slab.high = value;
}

Point point_of(uvec3 bits, int unit) {
  return Point(fixed_point(bits.x, unit), fixed_point(bits.y, unit), fixed_point(bits.z, unit));
}

// Returns a difference, shifted so that the longest side has its highest bit at bit 20, as a float without
// rounding.
float shortened(uvec2 difference, uint side_top) {
  const uvec2 magnitude = magnitude_of(difference);
  const float value =
      float(side_top > 20u ? shift_right(magnitude, side_top - 20u).x : magnitude.x << (20u - side_top));
  return is_negative(difference) ? -value : value;
}

vec3 shortened_difference(Point a, Point b, uint side_top) {
  return vec3(shortened(subtract(a.x, b.x), side_top), shortened(subtract(a.y, b.y), side_top),
              shortened(subtract(a.z, b.z), side_top));
}

// Whether a tetrahedron of four of the cluster's points is clearly a solid: one with the first point and
// those at a third and two thirds of the cluster. Coordinates are cut to 21 bits of the longest side. The
// determinant then has an error below 2^48 (docs/numerics.md), and 2^51 proves the rank.
void find_solid(uint begin, uint count, int unit) {
  const uvec3 origin_bits = bits_of(begin);
  const uvec3 a_bits = bits_of(begin + count / 3), b_bits = bits_of(begin + count / 3 * 2);
  if (!is_valid(origin_bits) || !is_valid(a_bits) || !is_valid(b_bits)) return;
  uvec2 side = uvec2(0u);
  for (uint axis = 0; axis < 3; ++axis) {
    const uvec2 length = subtract(axis_high[axis], axis_low[axis]);
    if (less(side, length)) side = length;
  }
  if (side == uvec2(0u)) return;
  const uint top = highest_bit(side);
  const Point origin = point_of(origin_bits, unit);
  const vec3 a = shortened_difference(point_of(a_bits, unit), origin, top);
  const vec3 b = shortened_difference(point_of(b_bits, unit), origin, top);
  const vec3 normal = cross(a, b);
  for (uint i = gl_LocalInvocationIndex; i < count; i += kThreads) {
    const uvec3 bits = bits_of(begin + i);
    if (!is_valid(bits)) continue;
    const vec3 c = shortened_difference(point_of(bits, unit), origin, top);
    if (abs(dot(normal, c)) > 2251799813685248.0) solid = true;
  }
}

void store(uint place, Slab slab) {
  thread_low[place * kRow + gl_LocalInvocationIndex] = slab.low;
  thread_high[place * kRow + gl_LocalInvocationIndex] = slab.high;
}

// Reduces the stored slabs of all threads and writes the results of slabs `first` to `first + count`.
void reduce(uint first, uint count, int unit) {
  barrier();
  const uint place = gl_LocalInvocationIndex >> 1;
  if (place < count) {
    const bool up = (gl_LocalInvocationIndex & 1u) != 0u;
    uvec2 best = up ? thread_high[place * kRow] : thread_low[place * kRow];
    for (uint thread = 1; thread < kThreads; ++thread) {
      const uvec2 other = up ? thread_high[place * kRow + thread] : thread_low[place * kRow + thread];
      if (up ? less(best, other) : less(other, best)) best = other;
    }
    if (first == 0u && place < 3u) {
      if (up) axis_high[place] = best;
      else axis_low[place] = best;
    }
    const uvec2 bits = double_bits(best, unit, up);
    const uint word = gl_WorkGroupID.x * kResultWords + 2u + 4u * (first + place) + (up ? 2u : 0u);
    results[word] = bits.x;
    results[word + 1] = bits.y;
  }
  barrier();
}

void main() {
  const uint cluster = gl_WorkGroupID.x;
  const uint begin = offsets[cluster], count = offsets[cluster + 1] - begin;
  if (gl_LocalInvocationIndex == 0) {
    lowest_bit = 0x7fffffff;
    highest_exponent = 0;
    valid_points = 0;
    solid = false;
  }
  barrier();
  int low = 0x7fffffff, high = 0;
  uint valid = 0;
  for (uint i = gl_LocalInvocationIndex; i < count; i += kThreads) {
    const uvec3 bits = bits_of(begin + i);
    if (!is_valid(bits)) continue;
    ++valid;
    find_exponents(bits.x, low, high);
    find_exponents(bits.y, low, high);
    find_exponents(bits.z, low, high);
  }
  if (valid > 0) {
    atomicAdd(valid_points, valid);
    atomicMin(lowest_bit, low);
    atomicMax(highest_exponent, high);
  }
  barrier();
  const int unit = lowest_bit;
  if (gl_LocalInvocationIndex == 0) {
    results[cluster * kResultWords] = valid_points;
    results[cluster * kResultWords + 1] = 0;
  }
  // Sums of three coordinates of 61 bits have 63 bits. Without any coordinate but 0, `unit` is too large,
  // too.
  if (valid_points < 4u || highest_exponent - unit > 60 || unit > 300) return;

  const Slab none = Slab(uvec2(0xffffffffu, 0x7fffffffu), uvec2(0u, 0x80000000u));
  Slab x = none, y = none, z = none, c0 = none, c1 = none, c2 = none, c3 = none;
  Slab e0 = none, e1 = none, e2 = none, e3 = none, e4 = none, e5 = none;
  for (uint i = gl_LocalInvocationIndex; i < count; i += kThreads) {
    const uvec3 bits = bits_of(begin + i);
    if (!is_valid(bits)) continue;
    const Point p = point_of(bits, unit);
    include(x, p.x);
    include(y, p.y);
    include(z, p.z);
    if (kSet == 0) continue;
    const uvec2 sum = add(p.x, p.y), difference = subtract(p.x, p.y);
    if (kCorners) {
      include(c0, add(sum, p.z));
      include(c1, subtract(sum, p.z));
      include(c2, add(difference, p.z));
      include(c3, subtract(difference, p.z));
    }
    if (kEdges) {
      include(e0, sum);
      include(e1, difference);
      include(e2, add(p.x, p.z));
      include(e3, subtract(p.x, p.z));
      include(e4, add(p.y, p.z));
      include(e5, subtract(p.y, p.z));
    }
  }
  store(0, x);
  store(1, y);
  store(2, z);
  reduce(0, 3, unit);
  if (kCorners) {
    store(0, c0);
    store(1, c1);
    store(2, c2);
    store(3, c3);
    reduce(kCornerSlab, 4, unit);
  }
  if (kEdges) {
    store(0, e0);
    store(1, e1);
    store(2, e2);
    reduce(kEdgeSlab, 3, unit);
    store(0, e3);
    store(1, e4);
    store(2, e5);
    reduce(kEdgeSlab + 3, 3, unit);
  }
  find_solid(begin, count, unit);
  barrier();
  if (gl_LocalInvocationIndex == 0 && solid) results[cluster * kResultWords + 1] = 1;
}
