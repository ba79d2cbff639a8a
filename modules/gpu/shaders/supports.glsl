// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Directions of a k-DOP and projections on them. Support 2k is the minimum along direction k, support 2k + 1
// the maximum. Keys of minima are inverted (~key), so that the extreme of every support is its largest key.

layout(constant_id = 0) const uint kSet = 3;  // directions: 0 axes, 1 dop14, 2 dop18, 3 dop26

const uint kBlockPoints = 1024;
const bool kCorners = kSet == 1 || kSet == 3;
const bool kEdges = kSet >= 2;
const uint kCornerSupport = 6;
const uint kEdgeSupport = kCorners ? 14 : 6;
const uint kSupports = 6 + (kCorners ? 8 : 0) + (kEdges ? 12 : 0);

bool is_valid(uvec3 bits) {
  return all(lessThan(bits & 0x7fffffffu, uvec3(0x7f800000u)));
}

uint without_negative_zero(uint bits) {
  return bits == 0x80000000u ? 0u : bits;  // -0 and 0 are equal coordinates
}

// Projections of p - center in float. docs/numerics.md bounds their error.
struct Projections {
  float corners[4], edges[6];
};

Projections project(uvec3 bits, vec3 center) {
  precise const float x = uintBitsToFloat(bits.x) - center.x;
  precise const float y = uintBitsToFloat(bits.y) - center.y;
  precise const float z = uintBitsToFloat(bits.z) - center.z;
  precise const float sum = x + y, difference = x - y;
  precise const float c0 = sum + z, c1 = sum - z, c2 = difference + z, c3 = difference - z;
  precise const float e2 = x + z, e3 = x - z, e4 = y + z, e5 = y - z;
  return Projections(float[](c0, c1, c2, c3), float[](sum, difference, e2, e3, e4, e5));
}
