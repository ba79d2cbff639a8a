// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scalar reference: the sums as moments.h defines them, one point at a time.

#include "moments_reference.h"

#include <algorithm>

#include "pcl_bv/kernels/chunks.h"

namespace pcl_bv {
namespace {

constexpr std::size_t kTerms = 9;
constexpr std::size_t kLanes = 8;

struct Lanes {
  double sums[kLanes][kTerms] = {};
};

std::size_t sum_block(const PointView& block, const Coordinates& origin, Lanes& lanes) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < block.count; ++i) {
    const Coordinates p = load_point(block, i);
    if (!is_valid(p)) continue;
    ++count;
    const double x = p.x - origin.x;
    const double y = p.y - origin.y;
    const double z = p.z - origin.z;
    const double terms[kTerms] = {x, y, z, x * x, x * y, x * z, y * y, y * z, z * z};
    for (std::size_t k = 0; k < kTerms; ++k)
      lanes.sums[i % kLanes][k] += terms[k];
  }
  return count;
}

}  // namespace

void chunk_moments_reference(const PointView& chunk, const Coordinates& origin, Moments& out) {
  out = Moments();
  Lanes total;
  for (std::size_t begin = 0; begin < chunk.count; begin += kBlockPoints) {
    Lanes block;
    out.count += sum_block(chunk.slice(begin, std::min(kBlockPoints, chunk.count - begin)), origin, block);
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      for (std::size_t k = 0; k < kTerms; ++k)
        total.sums[lane][k] += block.sums[lane][k];
  }
  for (const auto& lane : total.sums) {
    for (std::size_t k = 0; k < 3; ++k)
      out.sum[k] += lane[k];
    for (std::size_t k = 0; k < 6; ++k)
      out.product[k] += lane[3 + k];
  }
}

}  // namespace pcl_bv
