// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "references.h"

#include <cmath>

namespace pcl_bv {
namespace {

constexpr std::size_t kLanes = 8;

void sum_block(const PointView& block, Moments& out) {
  double lanes[kLanes][9] = {};
  const double scale = std::ldexp(1.0, out.exponent);
  for (std::size_t i = 0; i < block.count; ++i) {
    const Coordinates p = load_point(block, i);
    if (!is_valid(p)) continue;
    const double x = (p.x - out.origin.x) * scale;
    const double y = (p.y - out.origin.y) * scale;
    const double z = (p.z - out.origin.z) * scale;
    const double terms[] = {x, y, z, x * x, x * y, x * z, y * y, y * z, z * z};
    for (std::size_t k = 0; k < 9; ++k)
      lanes[i % kLanes][k] += terms[k];
  }
  out.sum = {};
  out.product = {};
  for (const auto& lane : lanes) {
    for (std::size_t k = 0; k < 9; ++k)
      (k < 3 ? out.sum[k] : out.product[k - 3]) += lane[k];
  }
}

}  // namespace

Moments block_moments_reference(const PointView& block) {
  Moments out;
  for (std::size_t i = 0; i < block.count; ++i) {
    const Coordinates p = load_point(block, i);
    if (!is_valid(p)) continue;
    if (out.count == 0) out.origin = p;
    ++out.count;
  }
  if (out.count > 0) sum_with_room(block.scalar, out, [&](Moments& moments) { sum_block(block, moments); });
  return out;
}

}  // namespace pcl_bv
