// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sums of many terms without rounding errors. The bounds of volumes are computed with such sums.
#pragma once

#include <array>
#include <cstddef>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// An exact sum of doubles and of products of doubles. Only the results of up(), down(), magnitude_up() and
/// value() are rounded.
///
/// Holds at most 44 terms (a product is two terms). When the capacity is reached, the terms are merged
/// without loss into at most 41. up(), down() and sign() first use a sum of twice the precision of a double
/// and its error bound. If the error bound leaves the result open, a non-overlapping expansion (Shewchuk
/// 1997) decides.
///
/// There is one inexact case. A product below 2^-960 in magnitude may lose about 2^-1074. Then is_lossless()
/// returns false, and up() and down() move outward by the smallest normal double if the loss could matter.
/// The caller must hold a FloatEnvironment.
class Expansion {
 public:
  static constexpr std::size_t kCapacity = 44;  ///< Maximum number of terms.

  /// Adds x, or a * b.
  Expansion& add(double x);
  Expansion& add_product(double a, double b);

  /// Adds a . b, which is six terms. The arguments may have any type that dot3() takes.
  template <typename A, typename B>
  Expansion& add_dot(const A& a, const B& b) {
    return add_product(a[0], b[0]).add_product(a[1], b[1]).add_product(a[2], b[2]);
  }

  /// Returns the smallest double >= the sum or the largest double <= the sum. On overflow up() returns
  /// +infinity and down() returns -infinity.
  double up() const;
  double down() const;
  double magnitude_up() const;  ///< Smallest double >= the magnitude of the sum.

  /// Returns the sum with an error below one unit in the last place. A sum that is a double is returned
  /// exactly.
  double value() const;

  /// Returns the sign (-1, 0 or 1) of the sum. The sign is exact if is_lossless().
  int sign() const;

  /// Returns false if digits may be lost, because a product is below 2^-960 in magnitude. Otherwise true.
  bool is_lossless() const { return !lossy_; }

 private:
  double error_bound() const;
  void compact();

  std::array<double, kCapacity> terms_;  // none of them is zero
  std::size_t size_ = 0;
  // The sum differs from head_ + low_ by at most error_bound().
  double head_ = 0, low_ = 0;
  double magnitude_ = 0;  // sum of the magnitudes of all terms
  bool lossy_ = false;
};

}  // namespace detail
}  // namespace pcl_bv
