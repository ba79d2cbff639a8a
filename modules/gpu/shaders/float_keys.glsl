// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Integer keys of floats, in the order of the floats. Integers keep denormal numbers, which a device may
// replace by 0 in float arithmetic.

const int kNoKey = -0x7fffffff - 1;  // below the key of every float

// Returns the key of a float, given by its bits. A larger float has a larger key; -0 is just below 0.
int key_of(uint bits) {
  return int(bits ^ (uint(int(bits) >> 31) & 0x7fffffffu));
}

// Returns the float of a key.
float float_of(int key) {
  return intBitsToFloat(key ^ ((key >> 31) & 0x7fffffff));
}
