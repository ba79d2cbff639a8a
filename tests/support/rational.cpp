// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "rational.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <ostream>

namespace pcl_bv::test {

struct Rational::Value {
  boost::multiprecision::cpp_rational number;
};

Rational::Rational() : value_(std::make_unique<Value>()) {}
Rational::Rational(FromDouble from) : Rational() {
  value_->number = from.value;
}
Rational::Rational(FromInteger from) : Rational() {
  value_->number = from.value;
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
  value_->number += other.value_->number;
  return *this;
}
Rational& Rational::operator-=(const Rational& other) {
  value_->number -= other.value_->number;
  return *this;
}
Rational& Rational::operator*=(const Rational& other) {
  value_->number *= other.value_->number;
  return *this;
}
Rational& Rational::operator/=(const Rational& other) {
  value_->number /= other.value_->number;
  return *this;
}

int Rational::compare(const Rational& other) const {
  return value_->number.compare(other.value_->number);
}

Rational::operator double() const {
  return static_cast<double>(value_->number);
}

std::ostream& operator<<(std::ostream& stream, const Rational& value) {
  return stream << value.value_->number;
}

}  // namespace pcl_bv::test
