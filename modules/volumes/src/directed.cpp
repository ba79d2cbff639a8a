// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Directed rounding by error-free transformations, so that no rounding mode has to be switched.
#include "directed.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "special_values.h"

namespace pcl_bv::volumes_internal {
namespace {

// Below this the error of a product may fall under the smallest denormal, 2^-1074.
constexpr double lossy_product = 0x1p-960;

// Squares of anything between 2^-400 and 2^400 are far from both ends of double; below, a factor of 2^600
// lifts them.
constexpr double small_extent = 0x1p-400;
constexpr double lift = 0x1p600;

struct TwoTerms {
  double sum, error;
};

TwoTerms two_sum(double a, double b) {
  const double s = a + b;
  const double b_part = s - a;
  return {s, (a - (s - b_part)) + (b - b_part)};
}

// Adds sign * (a - b)^2, six terms. a - b = d + e exactly.
void add_square_of_difference(ExactSum& sum, double a, double b, double sign) {
  const auto [d, e] = two_sum(a, -b);
  sum.add_product(sign * d, d).add_product(sign * 2 * d, e).add_product(sign * e, e);
}

}  // namespace

double next_up(double x) {
  return std::nextafter(x, infinity);
}

ExactSum& ExactSum::add(double x) {
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

ExactSum& ExactSum::add_product(double a, double b) {
  const double p = a * b;
  const bool exact = a == 0 || b == 0 || std::abs(a) == 1 || std::abs(b) == 1;
  if (!exact && std::abs(p) < lossy_product) lossy_ = true;
  add(p);
  return exact ? *this : add(std::fma(a, b, -p));
}

double ExactSum::value() const {
  double sum = 0;
  for (std::size_t i = 0; i < size_; ++i)
    sum += parts_[i];
  return sum;
}

int ExactSum::sign() const {
  if (size_ == 0) return 0;
  return parts_[size_ - 1] > 0 ? 1 : -1;
}

int ExactSum::compare(double x) const {
  return ExactSum(*this).add(-x).sign();
}

double ExactSum::up() const {
  if (size_ <= 1 && !lossy_) return value();
  double result = value();
  if (!std::isfinite(result)) return infinity;
  // value() is one of the two doubles beside the sum, or the sum itself.
  if (compare(result) > 0) result = next_up(result);
  return lossy_ ? next_up(result + smallest_normal) : result;
}

double ExactSum::down() const {
  return -negated().up();
}

ExactSum ExactSum::negated() const {
  ExactSum result(*this);
  for (std::size_t i = 0; i < size_; ++i)
    result.parts_[i] = -parts_[i];
  return result;
}

double add_up(double a, double b) {
  return ExactSum().add(a).add(b).up();
}

double multiply_up(double a, double b) {
  return ExactSum().add_product(a, b).up();
}

double sqrt_up(double a) {
  const double root = std::sqrt(a);
  return std::isfinite(root) && std::fma(root, root, -a) < 0 ? next_up(root) : root;
}

double norm_up(const Eigen::Vector3d& v) {
  const double largest = v.cwiseAbs().maxCoeff();
  if (largest == 0) return 0;
  if (largest < small_extent) return multiply_up(norm_up(v * lift), 1 / lift);
  ExactSum squared;
  for (const double x : v)
    squared.add_product(x, x);
  return sqrt_up(squared.up());
}

double distance_up(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Vector3d difference;
  for (int i = 0; i < 3; ++i)
    difference[i] = a[i] > b[i] ? add_up(a[i], -b[i]) : add_up(b[i], -a[i]);
  return norm_up(difference);
}

bool within(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double r, double s) {
  const double slack = r - s;
  const Eigen::Vector3d q = a - b;
  const double d2 = (q.x() * q.x() + q.y() * q.y()) + q.z() * q.z();
  // d2 is off by at most 5 units of 2^-53 and slack^2 by 3; 2^-48 is 32 of them.
  constexpr double doubt = 0x1p-48;
  const double limit = slack * slack;
  if (limit > small_extent * small_extent) {
    if (d2 < limit * (1 - doubt)) return true;
    if (d2 > limit * (1 + doubt)) return false;
  } else if (q.cwiseAbs().maxCoeff() < small_extent && r > 0 && r < small_extent) {
    return within(a * lift, b * lift, r * lift, s * lift);
  }
  ExactSum excess;
  for (int i = 0; i < 3; ++i)
    add_square_of_difference(excess, a[i], b[i], 1);
  add_square_of_difference(excess, r, s, -1);
  return excess.sign() <= 0 && excess.certain();
}

namespace {

// Denormal floats are built from their bits, ceil(x 2^149): a conversion would flush them where FTZ is set.
float denormal_up(double x) {
  const auto bits = [](double units) { return static_cast<std::uint32_t>(units); };
  if (x >= 0) return std::bit_cast<float>(bits(std::ceil(x * 0x1p149)));
  return std::bit_cast<float>(bits(std::floor(-x * 0x1p149)) | 0x80000000u);
}

}  // namespace

float float_up(double x) {
  constexpr double denormal_range = std::numeric_limits<float>::min();
  if (std::abs(x) < denormal_range) return denormal_up(x);
  const float nearest = static_cast<float>(x);
  return nearest < x ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

float float_down(double x) {
  return -float_up(-x);
}

}  // namespace pcl_bv::volumes_internal
