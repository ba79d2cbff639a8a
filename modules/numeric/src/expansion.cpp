// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/numeric/expansion.h"

#include <algorithm>
#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "two_sum.h"

namespace pcl_bv {
namespace {

// Below this the error of a product may fall under the smallest denormal, 2^-1074.
constexpr double kLossyProduct = 0x1p-960;

}  // namespace

Expansion& Expansion::add(double x) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    const auto [sum, error] = two_sum(x, parts_[i]);
    if (error != 0) parts_[kept++] = error;
    x = sum;
  }
  if (x != 0) parts_[kept++] = x;
  size_ = kept;
  return *this;
}

Expansion& Expansion::add_product(double a, double b) {
  const double p = a * b;
  const bool exact = a == 0 || b == 0 || std::abs(a) == 1 || std::abs(b) == 1;
  if (!exact && std::abs(p) < kLossyProduct) lossy_ = true;
  add(p);
  return exact ? *this : add(std::fma(a, b, -p));
}

double Expansion::value() const {
  double sum = 0;
  for (std::size_t i = 0; i < size_; ++i)
    sum += parts_[i];
  return sum;
}

int Expansion::sign() const {
  if (size_ == 0) return 0;
  return parts_[size_ - 1] > 0 ? 1 : -1;
}

double Expansion::up() const {
  if (size_ <= 1 && !lossy_) return value();
  double result = value();
  if (!std::isfinite(result)) return kInfinity;
  // value() is one of the two doubles beside the sum, or the sum itself.
  if (Expansion(*this).add(-result).sign() > 0) result = next_up(result);
  return lossy_ ? next_up(result + kSmallestNormal) : result;
}

double Expansion::down() const {
  return -negated().up();
}

double Expansion::magnitude_up() const {
  return std::max(up(), -down());
}

Expansion Expansion::negated() const {
  Expansion result(*this);
  for (std::size_t i = 0; i < size_; ++i)
    result.parts_[i] = -parts_[i];
  return result;
}

}  // namespace pcl_bv
