// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cmath>
#include <compare>
#include <concepts>
#include <iosfwd>
#include <limits>
#include <memory>

namespace pcl_bv::test {

/// An exact fraction of Boost.Multiprecision's integers, behind functions that are compiled once.
class Rational {
 public:
  Rational();
  template <std::floating_point T>
  explicit Rational(T value) : Rational(FromDouble{static_cast<double>(value)}) {}
  template <std::integral T>
  Rational(T value) : Rational(FromInteger{static_cast<long long>(value)}) {}
  Rational(const Rational& other);
  Rational(Rational&&) noexcept;
  Rational& operator=(const Rational& other);
  Rational& operator=(Rational&&) noexcept;
  ~Rational();

  Rational& operator+=(const Rational& other);
  Rational& operator-=(const Rational& other);
  Rational& operator*=(const Rational& other);
  Rational& operator/=(const Rational& other);

  friend Rational operator+(Rational a, const Rational& b) { return a += b; }
  friend Rational operator-(Rational a, const Rational& b) { return a -= b; }
  friend Rational operator*(Rational a, const Rational& b) { return a *= b; }
  friend Rational operator/(Rational a, const Rational& b) { return a /= b; }
  friend Rational operator-(const Rational& a) { return Rational(0) - a; }
  friend Rational abs(const Rational& a) { return a < 0 ? -a : a; }
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b) { return a.compare(b) <=> 0; }
  friend bool operator==(const Rational& a, const Rational& b) { return a.compare(b) == 0; }

  /// Negative, 0 or positive.
  int compare(const Rational& other) const;
  int sign() const;

  /// Rounded.
  explicit operator double() const;
  friend std::ostream& operator<<(std::ostream& stream, const Rational& value);

 private:
  struct Value;
  struct FromDouble {
    double value;
  };
  struct FromInteger {
    long long value;
  };
  explicit Rational(FromDouble from);
  explicit Rational(FromInteger from);

  std::unique_ptr<Value> value_;
};

/// The least double >= 0 with a square of at least this; `near` is where to look for it.
inline double least_root_above(const Rational& square, double near) {
  double root = near;
  const auto is_enough = [&](double r) { return Rational(r) * Rational(r) >= square; };
  while (!is_enough(root))
    root = std::nextafter(root, std::numeric_limits<double>::infinity());
  while (root > 0 && is_enough(std::nextafter(root, 0)))
    root = std::nextafter(root, 0);
  return root;
}

}  // namespace pcl_bv::test
