// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Error-free transformations (Shewchuk 1997).

#include "pcl_bv/numeric/exact_sum.h"

#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "two_sum.h"

namespace pcl_bv::detail {
ExactSum exact_sum(double x, double y, double z) {
  const TwoSum xy = two_sum(x, y);
  const TwoSum xyz = two_sum(xy.sum, z);
  if (xy.error == 0.0) return {xyz.sum, xyz.error, 0.0};
  const TwoSum errors = two_sum(xyz.error, xy.error);
  const TwoSum head = two_sum(xyz.sum, errors.sum);
  return {head.sum, head.error, errors.error};
}

// tail + rest, rounded to double, has the same sign as the exact tail + rest. So this sign tells whether the
// exact value lies above or below `head`. |tail + rest| is at most slightly more than half of the distance
// between `head` and the next double. Therefore the next double on that side bounds the exact value.
double round_down(const ExactSum& sum) {
  const double below = sum.tail + sum.rest;
  return (below < 0.0 ? next_down(sum.head) : sum.head) + 0.0;
}

double round_up(const ExactSum& sum) {
  const double above = sum.tail + sum.rest;
  return (above > 0.0 ? next_up(sum.head) : sum.head) + 0.0;
}

int compare(const ExactSum& a, const ExactSum& b) {
  const auto sign = [](double v) { return (v > 0.0) - (v < 0.0); };
  if (a.tail == 0.0 && a.rest == 0.0 && b.tail == 0.0 && b.rest == 0.0) return sign(a.head - b.head);
  return Expansion().add(a.rest).add(-b.rest).add(a.tail).add(-b.tail).add(a.head).add(-b.head).sign();
}

}  // namespace pcl_bv::detail
