// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sums of many terms without error: what the bounds of volumes are added up with.
#pragma once

#include <array>
#include <cstddef>

namespace [[gnu::visibility("default")]] pcl_bv {

/// A sum of doubles and of products of doubles held without error, as a non-overlapping expansion of growing
/// magnitude (Shewchuk 1997). At most 32 terms (a product is two). The one loss: a product below 2^-960 may
/// lose some 2^-1074; up() and down() then step a smallest normal further, and `certain()` is false. Expects
/// the IEEE default environment: hold a FloatEnvironment.
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
  Expansion negated() const;

  static constexpr std::size_t capacity = 33;  // 32 terms and the one that up() adds
  std::array<double, capacity> parts_;
  std::size_t size_ = 0;
  bool lossy_ = false;
};

}  // namespace pcl_bv
