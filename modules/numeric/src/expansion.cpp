// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/numeric/expansion.h"

#include <algorithm>
#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "two_sum.h"

namespace pcl_bv::detail {
namespace {

constexpr double kLossyProduct = 0x1p-960;

// A non-overlapping expansion. Its parts are in ascending order of their magnitudes.
class ExpansionParts {
 public:
  ExpansionParts(const double* terms, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      add(terms[i]);
  }

  void add(double x) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const auto [sum, error] = two_sum(x, parts_[i]);
      if (error != 0) parts_[kept++] = error;
      x = sum;
    }
    if (x != 0) parts_[kept++] = x;
    size_ = kept;
  }

  std::size_t size() const { return size_; }
  double operator[](std::size_t i) const { return parts_[i]; }

  double value() const {
    double sum = 0;
    for (std::size_t i = 0; i < size_; ++i)
      sum += parts_[i];
    return sum;
  }

  int sign() const {
    if (size_ == 0) return 0;
    return parts_[size_ - 1] > 0 ? 1 : -1;
  }

  // Makes each part the rounded sum of itself and all smaller parts (the first pass of Shewchuk's COMPRESS).
  // Then each part is at most 2^-52 of the next larger part. At most 41 such parts fit into the 2098 binary
  // digits that doubles span.
  void compress() {
    if (size_ == 0) return;
    std::size_t lowest = size_ - 1;
    double rounded = parts_[lowest];
    for (std::size_t i = size_ - 1; i-- > 0;) {
      const auto [sum, error] = two_sum(rounded, parts_[i]);
      if (error != 0) parts_[lowest--] = sum;
      rounded = error != 0 ? error : sum;
    }
    parts_[lowest] = rounded;
    std::copy(parts_.begin() + static_cast<std::ptrdiff_t>(lowest),
              parts_.begin() + static_cast<std::ptrdiff_t>(size_), parts_.begin());
    size_ -= lowest;
  }

 private:
  std::array<double, Expansion::kCapacity + 1> parts_;  // at most one per term, and one that up() adds
  std::size_t size_ = 0;
};

// Returns the smallest double >= head + low.
double sum_up(double head, double low) {
  const auto [sum, error] = two_sum(head, low);
  return error > 0 ? next_up(sum) : sum;
}

}  // namespace

Expansion& Expansion::add(double x) {
  if (x == 0) return *this;
  if (size_ == kCapacity) compact();
  terms_[size_++] = x;
  const auto [sum, error] = two_sum(head_, x);
  head_ = sum;
  low_ += error;
  magnitude_ += std::abs(x);
  return *this;
}

Expansion& Expansion::add_product(double a, double b) {
  const double p = a * b;
  const bool exact = a == 0 || b == 0 || std::abs(a) == 1 || std::abs(b) == 1;
  if (!exact && std::abs(p) < kLossyProduct) lossy_ = true;
  add(p);
  return exact ? *this : add(std::fma(a, b, -p));
}

// Merges the terms when there are kCapacity of them. At most 41 terms remain after compress().
void Expansion::compact() {
  ExpansionParts parts(terms_.data(), size_);
  parts.compress();
  size_ = 0;
  head_ = low_ = magnitude_ = 0;
  for (std::size_t i = 0; i < parts.size(); ++i)
    add(parts[i]);
}

// Returns a bound of the difference between the sum and head_ + low_. low_ is the sum of at most 44 errors,
// each at most 2^-53 of magnitude_. The additions to low_ make at most 44 more errors, each at most 2^-53 of
// the sum of the first ones. The total is at most 44^2 2^-106 < 2^-95 of magnitude_. If magnitude_ exceeds
// 2^-900, this bound also covers the loss of products below 2^-960. If magnitude_ is smaller, or so large
// that partial sums may overflow, the result is NaN. Comparisons with NaN are false, so the callers then use
// the non-overlapping expansion.
double Expansion::error_bound() const {
  return magnitude_ > 0x1p-900 && magnitude_ < 0x1p1000 ? 0x1p-95 * magnitude_ : kNan;
}

double Expansion::value() const {
  return ExpansionParts(terms_.data(), size_).value();
}

int Expansion::sign() const {
  if (std::abs(head_) > std::abs(low_) + error_bound()) return head_ > 0 ? 1 : -1;
  return ExpansionParts(terms_.data(), size_).sign();
}

double Expansion::up() const {
  const double least = sum_up(head_, low_ - error_bound());
  if (least == sum_up(head_, low_ + error_bound())) return least;
  ExpansionParts parts(terms_.data(), size_);
  double result = parts.value();
  if (parts.size() <= 1 && !lossy_) return result;
  if (!std::isfinite(result)) return kInfinity;
  // ExpansionParts::value() is the sum itself or one of the two neighbouring doubles.
  parts.add(-result);
  if (parts.sign() > 0) result = next_up(result);
  return lossy_ ? next_up(result + kSmallestNormal) : result;
}

double Expansion::down() const {
  Expansion negated;  // without a copy of the unused terms
  negated.size_ = size_;
  for (std::size_t i = 0; i < size_; ++i)
    negated.terms_[i] = -terms_[i];
  negated.head_ = -head_;
  negated.low_ = -low_;
  negated.magnitude_ = magnitude_;
  negated.lossy_ = lossy_;
  return -negated.up();
}

double Expansion::magnitude_up() const {
  return std::max(up(), -down());
}

}  // namespace pcl_bv::detail
