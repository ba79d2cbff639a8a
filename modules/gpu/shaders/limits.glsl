// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The limit of a support is the cloud's extreme minus an error bound, as a key. Every support point has a key at
// or above the limit of its support (docs/numerics.md). Needs `cloud_keys` and supports.glsl before it.

// The largest magnitude of p - center along an axis.
float magnitude(uint axis, float center) {
  precise const float low = float_of(~cloud_keys[2 * axis]) - center;
  precise const float high = float_of(cloud_keys[2 * axis + 1]) - center;
  return max(abs(low), abs(high));
}

// The band for projections whose terms have magnitudes of at most `sum` together: 2^-19 of it, and 2^-120 for
// denormal numbers that the device may replace by 0.
float band(float sum) {
  precise const float relative = sum * 1.9073486328125e-6;
  precise const float result = relative + 7.5231638452626401e-37;
  return result;
}

// Whether an edge direction (number 0 to 5 of them) has a component along an axis.
bool edge_has(uint edge, uint axis) {
  return axis == 0 ? edge < 4 : axis == 1 ? edge < 2 || edge >= 4 : edge >= 2;
}

// Returns the limit of a support. Along the axes the device has the coordinates themselves, or differences
// whose rounding keeps their order. A NaN or an overflow gives any limit; the host notices magnitudes for
// which this can happen, and does not use what is listed.
int limit_of(uint support, vec3 center) {
  const int key = cloud_keys[support];
  if (support < 6) return key;
  precise float sum = 0;
  for (uint axis = 0; axis < 3; ++axis) {
    const bool counts = support < kEdgeSupport || edge_has((support - kEdgeSupport) / 2, axis);
    if (counts) sum += magnitude(axis, center[axis]);
  }
  const bool low = (support & 1u) == 0;
  precise const float extreme = float_of(low ? ~key : key);
  precise const float limit = low ? extreme + band(sum) : extreme - band(sum);
  const int limit_key = key_of(floatBitsToUint(limit));
  return low ? ~limit_key : limit_key;
}
