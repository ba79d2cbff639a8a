// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Arithmetic with a known side of the error. Enclosure by exact arithmetic is then proven by composition:
// each step of a bound rounds outward, so the whole does.
// What several sources share is in a namespace of its own: other layers have internals with names like these.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace pcl_bv::volumes_internal {

/// The next double above.
double next_up(double x);

/// A sum of doubles and of products of doubles held without error, as a non-overlapping expansion of growing
/// magnitude (Shewchuk 1997). At most 32 terms (a product is two). The one loss: a product below 2^-960 may
/// lose some 2^-1074; up() and down() then step a smallest normal further, and `certain()` is false.
class ExactSum {
 public:
  ExactSum& add(double x);
  ExactSum& add_product(double a, double b);

  /// Smallest double not below the sum / greatest not above. Infinite on overflow.
  double up() const;
  double down() const;

  /// The sum to less than one unit in the last place; the sum itself where it is a double.
  double value() const;

  /// -1, 0 or 1; exact where certain().
  int sign() const;
  bool certain() const { return !lossy_; }

 private:
  ExactSum negated() const;
  int compare(double x) const;  // sign of sum - x

  static constexpr std::size_t capacity = 33;  // 32 terms and the one that compare() adds
  std::array<double, capacity> parts_;
  std::size_t size_ = 0;
  bool lossy_ = false;
};

/// a + b, a * b, sqrt(a), |v| and |a - b| in exact arithmetic, rounded up.
double add_up(double a, double b);
double multiply_up(double a, double b);
double sqrt_up(double a);
double norm_up(const Eigen::Vector3d& v);
double distance_up(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// Whether |a - b| <= r - s by exact arithmetic, for r >= s >= 0. False also where products underflow so far
/// that it cannot be decided.
bool within(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double r, double s);

/// Smallest float not below x / greatest not above, denormals included even where the host flushes them to
/// zero.
float float_up(double x);
float float_down(double x);

}  // namespace pcl_bv::volumes_internal
