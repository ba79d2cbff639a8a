// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Signed integers of 64 bits as pairs (low word, high word), and floats as multiples of a power of two. No
// device rounds integers, so sums and comparisons are exact.

const uint kExponentBias = 150;  // a float is its significand times 2^(exponent - 150)

// A float taken apart: magnitude = significand * 2^(exponent - kExponentBias).
struct Parts {
  uint significand;
  int exponent;
};

Parts parts_of(uint bits) {
  const uint biased = (bits >> 23) & 0xffu;
  const uint fraction = bits & 0x7fffffu;
  return Parts(biased == 0u ? fraction : fraction | 0x800000u, int(max(biased, 1u)));
}

uvec2 add(uvec2 a, uvec2 b) {
  uint carry;
  const uint low = uaddCarry(a.x, b.x, carry);
  return uvec2(low, a.y + b.y + carry);
}

uvec2 negate(uvec2 a) {
  return uvec2(0u - a.x, ~a.y + (a.x == 0u ? 1u : 0u));
}

uvec2 subtract(uvec2 a, uvec2 b) {
  return add(a, negate(b));
}

bool less(uvec2 a, uvec2 b) {
  return int(a.y) < int(b.y) || (a.y == b.y && a.x < b.x);
}

bool is_negative(uvec2 a) {
  return int(a.y) < 0;
}

uvec2 magnitude_of(uvec2 a) {
  return is_negative(a) ? negate(a) : a;
}

// Shifts by 0 to 63 bits. The right shift is for unsigned numbers.
uvec2 shift_left(uvec2 a, uint bits) {
  if (bits >= 32u) return uvec2(0u, a.x << (bits - 32u));
  return bits == 0u ? a : uvec2(a.x << bits, (a.y << bits) | (a.x >> (32u - bits)));
}
uvec2 shift_right(uvec2 a, uint bits) {
  if (bits >= 32u) return uvec2(a.y >> (bits - 32u), 0u);
  return bits == 0u ? a : uvec2((a.x >> bits) | (a.y << (32u - bits)), a.y >> bits);
}

// Returns the position of the highest bit of a positive number.
uint highest_bit(uvec2 a) {
  return a.y != 0u ? 32u + uint(findMSB(a.y)) : uint(findMSB(a.x));
}

// Returns a float as a multiple of 2^(unit - kExponentBias). `unit` must not exceed the exponent of the
// float's lowest set bit, nor be more than 60 below the exponent of its highest.
uvec2 fixed_point(uint bits, int unit) {
  const Parts parts = parts_of(bits);
  const int shift = parts.exponent - unit;
  const uvec2 magnitude = shift >= 0 ? shift_left(uvec2(parts.significand, 0u), uint(min(shift, 63)))
                                     : uvec2(parts.significand >> uint(min(-shift, 31)), 0u);
  return (bits >> 31) != 0u ? negate(magnitude) : magnitude;
}

// Returns the bits of number * 2^(unit - kExponentBias) as a double, rounded down, or up if `up`. Never -0.
uvec2 double_bits(uvec2 number, int unit, bool up) {
  const bool negative = is_negative(number);
  const uvec2 magnitude = magnitude_of(number);
  if (magnitude == uvec2(0u)) return uvec2(0u);
  const uint top = highest_bit(magnitude);
  uvec2 significand;  // its highest bit is bit 52
  bool lost = false;
  if (top <= 52u) {
    significand = shift_left(magnitude, 52u - top);
  } else {
    significand = shift_right(magnitude, top - 52u);
    lost = shift_left(significand, top - 52u) != magnitude;
  }
  const uint exponent = uint(int(top) + unit - int(kExponentBias) + 1023);
  // Adding 1 to the largest significand increments the exponent, as it must.
  uvec2 bits = uvec2(significand.x, (significand.y & 0xfffffu) | (exponent << 20));
  if (lost && negative != up) bits = add(bits, uvec2(1u, 0u));
  if (negative) bits.y |= 0x80000000u;
  return bits;
}
