// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "moment_tree.h"

#include <algorithm>
#include <cmath>

#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kFactors[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};

// Moves the origin of the moments. q' = q + d are the coordinates about the new origin. Then sum q' =
// sum q + n d and sum q'_i q'_j = sum q_i q_j + d_i sum q_j + d_j sum q_i + n d_i d_j.
void move_origin(const Coordinates& origin, const std::array<double, 3>& d, Moments& moments) {
  const double n = static_cast<double>(moments.count);
  const std::array<double, 3> s = moments.sum;
  for (std::size_t k = 0; k < 6; ++k) {
    const auto [i, j] = kFactors[k];
    moments.product[k] += (d[i] * s[j] + s[i] * d[j]) + n * (d[i] * d[j]);
  }
  for (std::size_t i = 0; i < 3; ++i)
    moments.sum[i] += n * d[i];
  moments.origin = origin;
}

}  // namespace

void coarsen(int exponent, Moments& moments) {
  if (exponent == moments.exponent) return;
  const double factor = std::ldexp(1.0, exponent - moments.exponent);
  for (double& s : moments.sum)
    s *= factor;
  for (double& p : moments.product)
    p = p * factor * factor;
  moments.exponent = exponent;
}

Moments merged(const Moments& first, const Moments& second) {
  if (second.count == 0) return first;
  if (first.count == 0) return second;
  Moments result = first, other = second;
  std::array<double, 3> d = {other.origin.x - result.origin.x, other.origin.y - result.origin.y,
                             other.origin.z - result.origin.z};
  const double farthest = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
  int exponent = std::min(result.exponent, other.exponent);
  while (exponent > 0 && std::ldexp(farthest, exponent) > 0x1p300)
    exponent -= 500;
  if (exponent > 0) {
    for (double& x : d)
      x = std::ldexp(x, exponent);
  }
  coarsen(exponent, result);
  coarsen(exponent, other);
  move_origin(result.origin, d, other);
  result.count += other.count;
  for (std::size_t i = 0; i < 3; ++i)
    result.sum[i] += other.sum[i];
  for (std::size_t k = 0; k < 6; ++k)
    result.product[k] += other.product[k];
  return result;
}

void MomentTree::append(const MomentNode& next) {
  nodes_.push_back(next);
  for (std::size_t n = nodes_.size(); n > 1; --n) {
    MomentNode& left = nodes_[n - 2];
    const MomentNode& right = nodes_[n - 1];
    const bool siblings = left.blocks == right.blocks && left.first + left.blocks == right.first &&
                          left.first % (2 * left.blocks) == 0;
    if (!siblings) return;
    left = {left.first, 2 * left.blocks, merged(left.moments, right.moments)};
    nodes_.resize(n - 1);
  }
}

void MomentTree::append(std::size_t first, const MomentTree& tree) {
  for (const MomentNode& node : tree)
    append(MomentNode{first + node.first, node.blocks, node.moments});
}

MomentTree moments_of(UsableIsa isa, const PointView& chunk, std::size_t first_block) {
  MomentTree tree;
  for (std::size_t block = 0; block * kBlockPoints < chunk.count; ++block)
    tree.append(first_block + block, block_moments(isa, block_of(chunk, block)));
  return tree;
}

Moments MomentTree::total() const {
  Moments total;
  for (std::size_t n = nodes_.size(); n-- > 0;)
    total = merged(nodes_[n].moments, total);
  return total;
}

}  // namespace pcl_bv::detail
