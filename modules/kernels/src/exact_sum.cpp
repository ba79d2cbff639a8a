// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Error-free transformations (Knuth's TwoSum; Shewchuk 1997). Needs -ffp-contract=off and round to nearest.

#include "pcl_bv/kernels/exact_sum.h"

#include <cmath>
#include <limits>

namespace pcl_bv {
namespace {

struct Pair {
  double sum, error;  // sum + error is exactly a + b
};

Pair two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

// Adds a term to an expansion whose parts do not overlap and grow in magnitude (Shewchuk's GROW-EXPANSION).
template <std::size_t n>
void grow(std::array<double, n>& expansion, std::size_t used, double term) {
  for (std::size_t i = 0; i < used; ++i) {
    const Pair part = two_sum(term, expansion[i]);
    expansion[i] = part.error;
    term = part.sum;
  }
  expansion[used] = term;
}

}  // namespace

ExactSum exact_sum(double x, double y, double z) {
  const Pair xy = two_sum(x, y);
  const Pair xyz = two_sum(xy.sum, z);
  if (xy.error == 0.0) return {xyz.sum, xyz.error, 0.0};
  const Pair errors = two_sum(xyz.error, xy.error);
  const Pair head = two_sum(xyz.sum, errors.sum);
  return {head.sum, head.error, errors.error};
}

ExactSum exact_projection(const std::array<std::int8_t, 3>& direction, const Coordinates& p) {
  return exact_sum(direction[0] * p.x, direction[1] * p.y, direction[2] * p.z);
}

// tail + rest is at most half a step of head and a tiny bit, and its rounded sum has its exact sign, so that
// sign alone says on which side of head the exact value lies, never farther than the next double.
double round_down(const ExactSum& sum) {
  const double below = sum.tail + sum.rest;
  const double bound =
      below < 0.0 ? std::nextafter(sum.head, -std::numeric_limits<double>::infinity()) : sum.head;
  return bound + 0.0;
}

double round_up(const ExactSum& sum) {
  const double above = sum.tail + sum.rest;
  const double bound =
      above > 0.0 ? std::nextafter(sum.head, std::numeric_limits<double>::infinity()) : sum.head;
  return bound + 0.0;
}

int compare(const ExactSum& a, const ExactSum& b) {
  const auto sign = [](double v) { return (v > 0.0) - (v < 0.0); };
  if (a.tail == 0.0 && a.rest == 0.0 && b.tail == 0.0 && b.rest == 0.0) return sign(a.head - b.head);
  std::array<double, 6> difference{};
  std::size_t used = 0;
  for (const double term : {a.rest, -b.rest, a.tail, -b.tail, a.head, -b.head})
    grow(difference, used++, term);
  for (std::size_t i = used; i-- > 0;) {
    if (difference[i] != 0.0) return sign(difference[i]);
  }
  return 0;
}

}  // namespace pcl_bv
