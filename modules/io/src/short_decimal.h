// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fast path for the short decimal numbers of clouds, which have at most a dozen digits and a magnitude near
// 1. It rounds exactly as std::from_chars does (Clinger 1990), or leaves the number to std::from_chars. It
// reads eight digits at a time (Lemire 2021).
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <type_traits>

namespace pcl_bv::detail {

/// Number of bytes after the text that read_short_decimal() may read.
inline constexpr std::size_t kTextPadding = 16;

/// Returns whether the character separates values within a line. Blanks are C's white space except line feed.
inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}
/// Returns whether the character ends a value. Blanks and line feeds do.
inline bool ends_value(char c) {
  return c == '\n' || is_blank(c);
}

static_assert(std::endian::native == std::endian::little, "the first digit is the lowest byte");

/// The digits at the beginning of a text of eight characters.
struct DigitRun {
  unsigned length;      ///< Number of digits, 0 to 8.
  std::uint64_t value;  ///< The digits as a decimal integer.
};

inline DigitRun read_digit_run(const char* at) {
  std::uint64_t text;
  std::memcpy(&text, at, sizeof text);
  const std::uint64_t digits = text ^ 0x3030303030303030;  // bytes of digits become 0 to 9
  // In `others`, the highest bit of a byte is set if the byte is not a digit. The addition can carry out of
  // such a byte, but only into later bytes, which do not matter.
  const std::uint64_t others = (digits | (digits + 0x7676767676767676)) & 0x8080808080808080;
  const unsigned length = others == 0 ? 8U : static_cast<unsigned>(std::countr_zero(others)) / 8;
  const unsigned half_shift = 32 - 4 * length;  // applied twice, since a shift by 64 is undefined
  std::uint64_t value = digits << half_shift << half_shift;
  value = value * 10 + (value >> 8);  // the values of pairs of digits, in every other byte
  constexpr std::uint64_t pairs = 0x000000FF000000FF;
  value = ((value & pairs) * (100 + (std::uint64_t{1000000} << 32)) +
           ((value >> 16) & pairs) * (1 + (std::uint64_t{10000} << 32))) >>
          32;
  return {length, value};
}

inline constexpr std::array<std::uint64_t, 9> integer_powers{1,      10,      100,      1000,     10000,
                                                             100000, 1000000, 10000000, 100000000};

/// The largest power of ten that a double represents exactly is 10^22.
inline constexpr int kMaxExactPower = 22;
inline constexpr std::array<double, kMaxExactPower + 1> double_powers{
    1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// The number digits * 10^exponent, where digits < 1e18.
struct Decimal {
  std::int64_t digits;
  int exponent;

  bool has_power() const { return exponent <= kMaxExactPower && exponent >= -kMaxExactPower; }

  /// Returns the value, rounded twice. First the digits become a double, then the product or quotient is
  /// rounded. Requires has_power().
  double magnitude() const {
    const double factor = double_powers[static_cast<unsigned>(std::abs(exponent))];
    return exponent < 0 ? static_cast<double>(digits) / factor : static_cast<double>(digits) * factor;
  }
};

/// Rounds to the nearest double. Returns false if a double cannot represent the digits or the power of ten
/// exactly. Otherwise only the product or quotient is rounded, so the result is correctly rounded (Clinger
/// 1990).
inline bool round_decimal(Decimal decimal, bool negative, double& value) {
  constexpr std::int64_t doubles_end = std::int64_t{1} << 53;
  if (decimal.digits > doubles_end || !decimal.has_power()) return false;
  const double magnitude = decimal.magnitude();
  value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(magnitude) | std::uint64_t{negative} << 63);
  return true;
}

/// Rounds to the nearest float through a double with an error of at most two units in its last place. Returns
/// false if the double is so near to the midpoint of two floats that the error could change the result.
inline bool round_decimal(Decimal decimal, bool negative, float& value) {
  if (!decimal.has_power()) return false;
  const double magnitude = decimal.magnitude();
  constexpr std::uint64_t middle = std::uint64_t{1} << 28, below_float = (middle << 1) - 1;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(magnitude);
  const bool near_middle = (bits & below_float) - (middle - 2) <= 4;
  // The float is never denormal, because a value other than 0 is at least 1e-22.
  if (near_middle || magnitude > static_cast<double>(std::numeric_limits<float>::max())) return false;
  const float rounded = static_cast<float>(magnitude);
  value = std::bit_cast<float>(std::bit_cast<std::uint32_t>(rounded) | std::uint32_t{negative} << 31);
  return true;
}

/// Reads an exponent such as "e-5", adds it to `exponent` and moves `at` behind the exponent. Returns false
/// if there is no exponent of 1 to 3 digits.
inline bool read_exponent(const char*& at, int& exponent) {
  ++at;
  const bool negative = *at == '-';
  at += negative || *at == '+';
  const DigitRun run = read_digit_run(at);
  if (run.length == 0 || run.length > 3) return false;
  at += run.length;
  exponent += negative ? -static_cast<int>(run.value) : static_cast<int>(run.value);
  return true;
}

/// Reads a number that is followed by a blank or a line end. Returns the position behind the number, or null
/// if this fast path cannot decide. If the result is null, the text may still be a valid number for
/// std::from_chars. The text must be followed by kTextPadding bytes that begin with a line feed.
template <typename T>
inline const char* read_short_decimal(const char* at, T& value) {
  static_assert(std::is_floating_point_v<T>);
  const bool negative = *at == '-';
  at += negative | (*at == '+');
  const char* const first = at;
  const DigitRun whole = read_digit_run(at);
  at += whole.length;
  Decimal decimal{static_cast<std::int64_t>(whole.value), 0};
  bool has_digits = whole.length > 0;
  if (*at == '.') {
    ++at;
    do {
      const DigitRun run = read_digit_run(at);
      if (decimal.digits >= 10'000'000'000) return nullptr;
      decimal.digits = decimal.digits * static_cast<std::int64_t>(integer_powers[run.length]) +
                       static_cast<std::int64_t>(run.value);
      decimal.exponent -= static_cast<int>(run.length);
      at += run.length;
    } while (*at >= '0' && *at <= '9');  // not length == 8, because a run of 8 digits often ends the number
    has_digits = at - first > 1;
  }
  if (!has_digits) return nullptr;
  if ((*at == 'e' || *at == 'E') && !read_exponent(at, decimal.exponent)) return nullptr;
  if (!ends_value(*at) || !round_decimal(decimal, negative, value)) return nullptr;
  return at;
}

}  // namespace pcl_bv::detail
