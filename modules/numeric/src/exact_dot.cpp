// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A product of doubles is an integer of 106 bits times a power of two; a few of them add up in fixed point
// without error. The words reach only from the least to the greatest of the terms at hand: four or so in
// practice, 66 at worst. Expansions would lose products below 2^-1074, and double clouds have such.

#include "pcl_bv/numeric/exact_dot.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/exact_sum.h"

namespace pcl_bv {
namespace {

__extension__ using Wide = unsigned __int128;

// sign * mantissa * 2^exponent.
struct Term {
  Wide mantissa;
  int exponent;
  bool negative;
};

struct Parts {
  std::uint64_t mantissa;
  int exponent;
  bool negative;
};

Parts parts_of(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const int biased = static_cast<int>(bits >> 52 & 0x7FFU);
  const std::uint64_t fraction = bits & 0xF'FFFF'FFFF'FFFFU;
  return {biased == 0 ? fraction : fraction | std::uint64_t{1} << 52, std::max(biased, 1) - 1075,
          bits >> 63 != 0};
}

// std::ldexp, which is right for all exponents, and slow.
double scaled(double mantissa, int exponent) {
  if (exponent < -1022 || exponent > 1023) return std::ldexp(mantissa, exponent);
  return mantissa * std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

// At most two dot products.
class ExactDot {
 public:
  void add(const Direction& n, const Coordinates& p, bool negative = false) {
    add(n[0], p.x, negative);
    add(n[1], p.y, negative);
    add(n[2], p.z, negative);
  }

  int sign() {
    sum_up();
    if (is_negative()) return -1;
    return std::any_of(words_.begin(), words_.begin() + used_, [](std::uint64_t w) { return w != 0; }) ? 1
                                                                                                       : 0;
  }

  double round(bool up) {
    sum_up();
    const bool negative = is_negative();
    if (negative) negate();
    int last = used_ - 1;
    while (last > 0 && word(last) == 0)
      --last;
    const int top = 64 * last + static_cast<int>(std::bit_width(word(last))) - 1;
    // Bits below the last one that a double of this size has, whose exponent is at least -1074.
    const int excess = std::max({top - 52, -1074 - base_, 0});
    std::uint64_t mantissa = bits_from(excess) & ((std::uint64_t{1} << 53) - 1);
    if (up != negative && any_below(excess)) ++mantissa;
    const double magnitude = scaled(static_cast<double>(mantissa), base_ + excess);
    return (negative ? -magnitude : magnitude) + 0.0;
  }

 private:
  static constexpr int kMaxWords = 67;  // 2 * (1074 + 971) bits between exponents, a product, carries, a sign

  void add(double a, double b, bool negative) {
    const Parts x = parts_of(a);
    const Parts y = parts_of(b);
    if (x.mantissa == 0 || y.mantissa == 0) return;
    terms_[count_++] = {static_cast<Wide>(x.mantissa) * y.mantissa, x.exponent + y.exponent,
                        (x.negative != y.negative) != negative};
  }

  // The terms as one integer in two's complement, of units of 2^base_.
  void sum_up() {
    int greatest = std::numeric_limits<int>::min();
    base_ = std::numeric_limits<int>::max();
    for (std::size_t t = 0; t < count_; ++t) {
      base_ = std::min(base_, terms_[t].exponent);
      greatest = std::max(greatest, terms_[t].exponent);
    }
    if (count_ == 0) base_ = greatest = 0;
    used_ = (greatest - base_ + 106 + 4) / 64 + 1;  // 4: up to 8 terms, and the sign
    std::fill_n(words_.begin(), used_, 0);
    for (std::size_t t = 0; t < count_; ++t)
      add(terms_[t]);
  }

  void add(const Term& term) {
    const int shift = term.exponent - base_;
    const int offset = shift % 64;
    const Wide low = term.mantissa << offset;
    const std::uint64_t parts[3] = {
        static_cast<std::uint64_t>(low), static_cast<std::uint64_t>(low >> 64),
        offset == 0 ? 0 : static_cast<std::uint64_t>(term.mantissa >> (128 - offset))};
    const std::uint64_t flip = term.negative ? ~std::uint64_t{0} : 0;
    std::uint64_t carry = term.negative ? 1 : 0;
    for (int w = shift / 64, part = 0; w < used_; ++w, ++part) {
      const Wide sum = Wide{words_[w]} + ((part < 3 ? parts[part] : 0) ^ flip) + carry;
      words_[w] = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64);
    }
  }

  bool is_negative() const { return words_[used_ - 1] >> 63 != 0; }

  void negate() {
    std::uint64_t carry = 1;
    for (int w = 0; w < used_; ++w) {
      std::uint64_t& word = words_[w];
      word = ~word + carry;
      carry = carry != 0 && word == 0 ? 1 : 0;
    }
  }

  std::uint64_t word(int w) const { return w < used_ ? words_[w] : 0; }

  std::uint64_t bits_from(int first) const {
    const int offset = first % 64;
    const std::uint64_t low = word(first / 64) >> offset;
    return offset == 0 ? low : low | word(first / 64 + 1) << (64 - offset);
  }

  bool any_below(int end) const {
    for (int w = 0; w < end / 64; ++w) {
      if (word(w) != 0) return true;
    }
    return (word(end / 64) & ((std::uint64_t{1} << end % 64) - 1)) != 0;
  }

  std::array<Term, 6> terms_;
  std::size_t count_ = 0;
  int base_ = 0;
  int used_ = 0;
  std::array<std::uint64_t, kMaxWords> words_;  // not initialised: most are never used
};

// Bits of the mantissa from the first to the last that is set, or more (denormal numbers).
int width(double value) {
  const Parts parts = parts_of(value);
  return parts.mantissa == 0 ? 0 : 53 - std::countr_zero(parts.mantissa);
}

bool is_exact(double product, double a, double b) {
  if (a == 0 || b == 0 || a == 1 || a == -1) return true;
  const int wide = width(a), other = width(b);
  return (wide == 1 || other == 1 || wide + other <= 53) && std::abs(product) >= 0x1p-960;
}

// Three products and two sums, which are off by at most 3.01 * 2^-53 of the sum of magnitudes.
struct Rounded {
  Rounded(const Direction& n, const Coordinates& p) : x(n[0] * p.x), y(n[1] * p.y), z(n[2] * p.z) {}

  double value() const { return (x + y) + z; }
  double magnitude() const { return (std::abs(x) + std::abs(y)) + std::abs(z); }
  bool has_exact_products(const Direction& n, const Coordinates& p) const {
    return is_exact(x, n[0], p.x) && is_exact(y, n[1], p.y) && is_exact(z, n[2], p.z);
  }
  ExactSum sum() const { return exact_sum(x, y, z); }

  double x, y, z;
};

double project(const Direction& n, const Coordinates& p, bool up) {
  const Rounded rounded(n, p);
  if (rounded.has_exact_products(n, p)) return up ? round_up(rounded.sum()) : round_down(rounded.sum());
  ExactDot dot;
  dot.add(n, p);
  return dot.round(up);
}

}  // namespace

int compare_along(const Direction& n, const Coordinates& p, const Coordinates& q) {
  // Along an axis the coordinates tell: of a wall all points tie.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (n[(axis + 1) % 3] != 0 || n[(axis + 2) % 3] != 0) continue;
    const int order = (p[axis] > q[axis]) - (p[axis] < q[axis]);
    return n[axis] < 0 ? -order : n[axis] > 0 ? order : 0;
  }
  const Rounded a(n, p);
  const Rounded b(n, q);
  const double difference = a.value() - b.value();
  // The smallest normal covers products that underflow.
  const double doubt = 0x1p-51 * (a.magnitude() + b.magnitude()) + kSmallestNormal;
  if (difference > doubt) return 1;
  if (difference < -doubt) return -1;
  // Floats times integers, or times powers of two: a tie takes 20 ns, not 48.
  if (a.has_exact_products(n, p) && b.has_exact_products(n, q)) return compare(a.sum(), b.sum());
  ExactDot exact;
  exact.add(n, p);
  exact.add(n, q, true);
  return exact.sign();
}

double project_down(const Direction& n, const Coordinates& p) {
  return project(n, p, false);
}

double project_up(const Direction& n, const Coordinates& p) {
  return project(n, p, true);
}

}  // namespace pcl_bv
