// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "rational.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <ostream>
#include <stdexcept>

namespace pcl_bv::test {

using boost::multiprecision::cpp_int;
using boost::multiprecision::cpp_rational;

/// numerator / denominator * 2^exponent. Doubles are integers times powers of two, so that nearly all sums
/// and products have the denominator 1: a cpp_rational, which looks for common divisors after each step,
/// takes 5 to 20 times as long.
struct Rational::Value {
  cpp_int numerator = 0;
  cpp_int denominator = 1;  // > 0
  int exponent = 0;

  void cut_zeros() {
    if (numerator == 0) {
      *this = Value();
      return;
    }
    const auto zeros = lsb(boost::multiprecision::abs(numerator));
    numerator >>= zeros;
    exponent += static_cast<int>(zeros);
  }

  void add(const Value& other, int sign) {
    cpp_int theirs = sign * other.numerator;
    if (denominator != other.denominator) {
      theirs *= denominator;
      numerator *= other.denominator;
      denominator *= other.denominator;
    }
    if (exponent > other.exponent) {
      numerator <<= exponent - other.exponent;
      exponent = other.exponent;
    } else {
      theirs <<= other.exponent - exponent;
    }
    numerator += theirs;
    cut_zeros();
  }

  cpp_rational reduced() const {
    return {cpp_int(numerator << std::max(exponent, 0)), cpp_int(denominator << std::max(-exponent, 0))};
  }
};

Rational::Rational() : value_(std::make_unique<Value>()) {}
Rational::Rational(FromDouble from) : Rational() {
  if (!std::isfinite(from.value)) throw std::invalid_argument("Rational: no finite number");
  const double fraction = std::frexp(from.value, &value_->exponent);
  value_->numerator = static_cast<long long>(std::ldexp(fraction, 53));
  value_->exponent -= 53;
  value_->cut_zeros();
}
Rational::Rational(FromInteger from) : Rational() {
  value_->numerator = from.value;
}
Rational::Rational(const Rational& other) : value_(std::make_unique<Value>(*other.value_)) {}
Rational::Rational(Rational&&) noexcept = default;
Rational& Rational::operator=(const Rational& other) {
  value_ = std::make_unique<Value>(*other.value_);
  return *this;
}
Rational& Rational::operator=(Rational&&) noexcept = default;
Rational::~Rational() = default;

Rational& Rational::operator+=(const Rational& other) {
  value_->add(*other.value_, 1);
  return *this;
}
Rational& Rational::operator-=(const Rational& other) {
  value_->add(*other.value_, -1);
  return *this;
}
Rational& Rational::operator*=(const Rational& other) {
  value_->numerator *= other.value_->numerator;
  value_->denominator *= other.value_->denominator;
  value_->exponent += other.value_->exponent;
  return *this;
}
Rational& Rational::operator/=(const Rational& other) {
  if (other.sign() == 0) throw std::invalid_argument("Rational: division by zero");
  const Value by = *other.value_;
  value_->numerator *= by.numerator.sign() * by.denominator;
  value_->denominator *= boost::multiprecision::abs(by.numerator);
  value_->exponent -= by.exponent;
  return *this;
}

int Rational::compare(const Rational& other) const {
  Value difference = *value_;
  difference.add(*other.value_, -1);
  return difference.numerator.sign();
}

int Rational::sign() const {
  return value_->numerator.sign();
}

Rational::operator double() const {
  return static_cast<double>(value_->reduced());
}

std::ostream& operator<<(std::ostream& stream, const Rational& value) {
  return stream << value.value_->reduced();
}

}  // namespace pcl_bv::test
