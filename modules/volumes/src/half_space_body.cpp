// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "half_space_body.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bounds.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {

void HalfSpaceBody::reserve(std::size_t count) {
  normals_.reserve(count + box_sides);
  offsets_.reserve(count + box_sides);
}

void HalfSpaceBody::add(const Eigen::Vector3d& normal, double offset, const Eigen::Vector3d& origin) {
  if (normal.isZero(0)) return;
  double unit = power_of_two(normal);
  if (Eigen::Vector3d(normal / unit) * unit != normal) unit = 1;  // else a component underflows
  const double local = divide_up(Expansion().add(offset).add_dot(-normal, origin).up(), unit);
  if (!std::isfinite(local)) return;
  normals_.push_back(normal / unit);
  offsets_.push_back(local);
}

// The bound of each side of the box is proven without the half-spaces of the box, with a residual r. If |r|_1
// < 1 for all six directions +-e_k, the body is bounded. Proof: a vector v in the body's recession cone whose
// largest component is v_k = +-1 would satisfy 1 = +-e_k . v = sum w_i n_i . v + r . v <= |r|_1 < 1, a
// contradiction. Therefore, |q|_inf has a maximum R over the body, and R <= largest_bound + |r|_1 R.
bool HalfSpaceBody::add_box(double guess) {
  const std::size_t usable = size();
  for (int side = 0; side < 6; ++side) {
    normals_.push_back((side < 3 ? 1 : -1) * Eigen::Vector3d::Unit(side % 3));
    offsets_.push_back(guess);
  }
  std::array<DualBound, box_sides> bounds;
  double largest_bound = 0, residual = 0;
  for (std::size_t side = 0; side < box_sides; ++side) {
    const Eigen::Vector3d direction = normals_[usable + side];
    const DualSimplex simplex{normals_, offsets_, direction};
    bounds[side] = prove(simplex.solve(start(simplex), 0x1p-50 * guess, 0), direction, usable);
    if (!std::isfinite(bounds[side].bound) || !bounds[side].residual.allFinite()) return false;
    largest_bound = std::max(largest_bound, bounds[side].bound);
    residual = std::max(residual, taxicab3(bounds[side].residual));
  }
  if (residual > 0.25) return false;
  const double largest = largest_bound / (1 - residual) * (1 + 0x1p-50);
  for (std::size_t side = 0; side < box_sides; ++side) {
    const double rest = taxicab3(bounds[side].residual) * largest * (1 + 0x1p-50) + kSmallestNormal;
    offsets_[usable + side] = add_up(bounds[side].bound, rest);
  }
  for (std::size_t k = 0; k < 3; ++k)
    max_abs_[static_cast<int>(k)] = std::max({0.0, offsets_[usable + k], offsets_[usable + k + 3]});
  return true;
}

double HalfSpaceBody::radius_up() const {
  return norm_up(max_abs_);
}

// Uses only half-spaces with an index below `usable`. The sums are off by at most 4.01 U of their terms,
// where U = 2^-53. The error bound of 8 U also covers the rounding when the error bound is added.
HalfSpaceBody::DualBound HalfSpaceBody::prove(const DualBasis& basis, const Eigen::Vector3d& direction,
                                              std::size_t usable) const {
  Eigen::Vector3d rest = direction, terms = direction.cwiseAbs();
  double sum = 0, magnitude = 0;
  for (int k = 0; k < 3; ++k) {
    const std::size_t i = basis.sides[static_cast<std::size_t>(k)];
    const double weight = basis.weights[k];
    if (i >= usable || weight == 0) continue;
    sum += weight * offsets_[i];
    magnitude += weight * std::abs(offsets_[i]);
    const Eigen::Vector3d part = weight * normals_[i];
    rest -= part;
    terms += part.cwiseAbs();
  }
  return {sum + (0x1p-50 * magnitude + kSmallestNormal), rest.cwiseAbs() + 0x1p-50 * terms};
}

double HalfSpaceBody::bound(const DualBasis& basis, const Eigen::Vector3d& direction) const {
  const auto [dual_bound, residual] = prove(basis, direction, size());
  const double rest = dot3(residual, max_abs_) * (1 + 0x1p-50) + kSmallestNormal;
  return dual_bound + rest + 0x1p-51 * (std::abs(dual_bound) + rest);
}

// First uses only the half-spaces at the vertex and those of the box. They usually suffice. If rounding hides
// a short edge at the vertex, uses all half-spaces.
double HalfSpaceBody::support_value_up(const Eigen::Vector3d& direction,
                                       const Eigen::Vector3d& vertex) const {
  const double extent = std::max({max_abs_[0], max_abs_[1], max_abs_[2]});
  std::vector<double> slack(size());
  for (std::size_t i = 0; i < slack.size(); ++i)
    slack[i] = offsets_[i] - normals_.projection(i, vertex);
  std::vector<std::size_t> tight;
  tight.reserve(16);  // enough for most vertices and the box
  for (std::size_t i = 0; i < slack.size(); ++i) {
    if (slack[i] <= 0x1p-34 * extent || i + box_sides >= slack.size()) tight.push_back(i);
  }
  const double tolerance = 0x1p-51 * extent;
  const DualSimplex simplex{normals_, slack, direction};
  const DualBasis local = simplex.solve(start(simplex), tolerance, 0, &tight);
  const double first = bound(local, direction);
  if (first - dot3(direction, vertex) <= 0x1p-49 * extent) return first;
  return std::min(first, bound(simplex.solve(local, tolerance, 0), direction));
}

}  // namespace pcl_bv::detail
