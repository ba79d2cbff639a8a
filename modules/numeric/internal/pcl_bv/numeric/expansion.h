// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sums of many terms without error: what the bounds of volumes are added up with.
#pragma once

#include <array>
#include <cstddef>

namespace [[gnu::visibility("default")]] pcl_bv {

/// A sum of doubles and of products of doubles without error. At most 32 terms (a product is two). Twice the
/// precision of a double answers nearly always; where it cannot, the terms become a non-overlapping expansion
/// (Shewchuk 1997). The one loss: a product below 2^-960 may lose some 2^-1074; then `certain()` is false, and
/// up() and down() step a smallest normal further where so little can matter. Expects the IEEE default
/// environment: hold a FloatEnvironment.
class Expansion {
 public:
  Expansion& add(double x);
  Expansion& add_product(double a, double b);

  /// a . b, six terms, of vectors as dot3() takes them.
  template <typename A, typename B>
  Expansion& add_dot(const A& a, const B& b) {
    return add_product(a[0], b[0]).add_product(a[1], b[1]).add_product(a[2], b[2]);
  }

  /// Smallest double not below the sum / greatest not above. Infinite on overflow.
  double up() const;
  double down() const;
  double magnitude_up() const;  ///< Of its magnitude.

  /// The sum to less than one unit in the last place; the sum itself where it is a double.
  double value() const;

  /// -1, 0 or 1; exact where certain().
  int sign() const;
  bool certain() const { return !lossy_; }

 private:
  double missing() const;
  void compact();

  static constexpr std::size_t capacity = 32;
  std::array<double, capacity> terms_;  // none is zero
  std::size_t size_ = 0;
  // The sum is head_ + low_, but for missing() at most.
  double head_ = 0, low_ = 0;
  double magnitude_ = 0;  // of all terms
  bool lossy_ = false;
};

}  // namespace pcl_bv
