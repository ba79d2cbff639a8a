// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Weak duality proves the bounds. Weights w_i >= 0 with sum w_i n_i = d - r prove d . q <= sum w_i offset_i +
// r . q for every q of the body. The proof holds for any weights >= 0, so the weights are computed in plain
// double.
#include "half_spaces.h"

#include <algorithm>
#include <cmath>

#include "bounds.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {

/// The dual simplex method (Lemke 1954). Each step replaces one of the three half-spaces of the basis by the
/// half-space that the corner violates most, such that the weights stay >= 0. Up to rounding, no step makes
/// the proven bound larger.
class HalfSpaces::DualSimplex {
 public:
  /// `near` is a point near the sought corner. Offsets relative to it lose no digits.
  DualSimplex(const HalfSpaces& all, const Eigen::Vector3d& direction, const Eigen::Vector3d& near)
      : all_(all), direction_(direction), slack_(all.size()) {
    const std::size_t count = all.size();
    for (std::size_t i = 0; i < count; ++i)
      slack_[i] = all.offset_[i] - ((all.x_[i] * near[0] + all.y_[i] * near[1]) + all.z_[i] * near[2]);
  }

  /// Returns the half-spaces with a slack of at most `tolerance` at `near`, and the half-spaces of the box.
  std::vector<std::size_t> tight(double tolerance) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < slack_.size(); ++i) {
      if (slack_[i] <= tolerance || i + box_sides >= slack_.size()) found.push_back(i);
    }
    return found;
  }

  /// Improves the basis until its corner violates none of the candidates by more than the tolerance. The
  /// limit of 60 steps prevents an infinite loop by cycling. If the limit is reached, the bound is valid but
  /// less tight.
  template <typename Candidates>
  Basis solve(Basis basis, double tolerance, const Candidates& candidates) const {
    for (int step = 0; step < 60; ++step) {
      const Frame frame(all_, basis);
      const Eigen::Vector3d corner =
          frame.corner_at({slack_[basis.sides[0]], slack_[basis.sides[1]], slack_[basis.sides[2]]});
      const std::size_t entering = most_violated(corner, tolerance, candidates);
      if (entering == all_.size() || !frame.exchange(all_.normal(entering), entering, basis)) break;
    }
    return refined(basis);
  }

 private:
  // The three normals of a basis and their cross products. crosses[k] / determinant is column k of the
  // inverse of the matrix whose rows are the normals.
  struct Frame {
    Frame(const HalfSpaces& all, const Basis& basis) {
      for (std::size_t k = 0; k < 3; ++k)
        normals[k] = all.normal(basis.sides[k]);
      for (std::size_t k = 0; k < 3; ++k)
        crosses[k] = cross3(normals[(k + 1) % 3], normals[(k + 2) % 3]);
      determinant = dot3(normals[0], crosses[0]);
    }

    // Returns the corner q with normals[k] . q = s[k].
    Eigen::Vector3d corner_at(const Eigen::Vector3d& s) const {
      return ((s[0] / determinant) * crosses[0] + (s[1] / determinant) * crosses[1]) +
             (s[2] / determinant) * crosses[2];
    }

    // Returns the coefficients c with d = sum of c[k] * normals[k].
    Eigen::Vector3d components(const Eigen::Vector3d& d) const {
      return {dot3(crosses[0], d) / determinant, dot3(crosses[1], d) / determinant,
              dot3(crosses[2], d) / determinant};
    }

    // Replaces one of the three half-spaces of the basis by the half-space `entering`. Returns false if none
    // can be replaced.
    bool exchange(const Eigen::Vector3d& normal, std::size_t entering, Basis& basis) const {
      const Eigen::Vector3d component = components(normal);
      const double negligible =
          0x1p-40 * std::max({std::abs(component[0]), std::abs(component[1]), std::abs(component[2])});
      int leaving = -1;
      double step = kInfinity;
      for (int k = 0; k < 3; ++k) {
        if (!(component[k] > negligible)) continue;
        const double ratio = basis.weights[k] / component[k];
        if (ratio > step || (ratio == step && component[k] <= component[leaving])) continue;
        leaving = k;
        step = ratio;
      }
      if (leaving < 0) return false;
      for (int k = 0; k < 3; ++k)
        basis.weights[k] = std::max(0.0, basis.weights[k] - step * component[k]);
      basis.weights[leaving] = step;
      basis.sides[static_cast<std::size_t>(leaving)] = entering;
      return true;
    }

    std::array<Eigen::Vector3d, 3> normals, crosses;
    double determinant;
  };

  template <typename Candidates>
  std::size_t most_violated(const Eigen::Vector3d& corner, double tolerance,
                            const Candidates& candidates) const {
    std::size_t found = all_.size();
    double worst = tolerance;
    candidates([&](std::size_t i) {
      const double excess =
          ((all_.x_[i] * corner[0] + all_.y_[i] * corner[1]) + all_.z_[i] * corner[2]) - slack_[i];
      if (!(excess > worst)) return;
      worst = excess;
      found = i;
    });
    return found;
  }

  // Corrects the weights by their residual, because rounding errors of the steps add up and normals of
  // neighbouring faces are nearly parallel. For bodies of 200 half-spaces and directions of length 1, the
  // residual is at most 3e-14 before and 2e-15 after the correction.
  Basis refined(Basis basis) const {
    const Frame frame(all_, basis);
    for (int round = 0; round < 2; ++round) {
      Eigen::Vector3d rest = direction_;
      for (int k = 0; k < 3; ++k)
        rest -= basis.weights[k] * frame.normals[static_cast<std::size_t>(k)];
      const Eigen::Vector3d more = frame.components(rest);
      for (int k = 0; k < 3; ++k)
        basis.weights[k] = std::max(0.0, basis.weights[k] + more[k]);
    }
    return basis;
  }

  const HalfSpaces& all_;
  const Eigen::Vector3d& direction_;
  std::vector<double> slack_;
};

void HalfSpaces::reserve(std::size_t count) {
  for (std::vector<double>* v : {&x_, &y_, &z_, &offset_})
    v->reserve(count + box_sides);
}

void HalfSpaces::add(const Eigen::Vector3d& normal, double offset, const Eigen::Vector3d& origin) {
  const double largest = std::max({std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2])});
  if (!(largest > 0)) return;
  double unit = std::ldexp(1.0, std::clamp(std::ilogb(largest), -1000, 1000));
  if (Eigen::Vector3d(normal / unit) * unit != normal) unit = 1;  // else a component underflows
  const double local = divide_up(Expansion().add(offset).add_dot(-normal, origin).up(), unit);
  const Eigen::Vector3d scaled = normal / unit;
  if (!std::isfinite(local)) return;
  x_.push_back(scaled[0]);
  y_.push_back(scaled[1]);
  z_.push_back(scaled[2]);
  offset_.push_back(local);
}

// The bound of each side of the box is proven without the half-spaces of the box, with a residual r. If |r|_1
// < 1 for all six directions +-e_k, the body is bounded. Proof: a vector v in the body's recession cone whose
// largest component is v_k = +-1 would satisfy 1 = +-e_k . v = sum w_i n_i . v + r . v <= |r|_1 < 1, a
// contradiction. Therefore, |q|_inf has a maximum R over the body, and R <= largest_bound + |r|_1 R.
bool HalfSpaces::add_box(double guess) {
  const std::size_t usable = size();
  for (int side = 0; side < 6; ++side) {
    x_.push_back(side % 3 == 0 ? (side < 3 ? 1 : -1) : 0);
    y_.push_back(side % 3 == 1 ? (side < 3 ? 1 : -1) : 0);
    z_.push_back(side % 3 == 2 ? (side < 3 ? 1 : -1) : 0);
    offset_.push_back(guess);
  }
  std::array<DualBound, box_sides> bounds;
  double largest_bound = 0, residual = 0;
  for (std::size_t side = 0; side < box_sides; ++side) {
    const Eigen::Vector3d direction = normal(usable + side);
    const auto every = [&](const auto& visit) {
      for (std::size_t i = 0; i < size(); ++i)
        visit(i);
    };
    const DualSimplex simplex(*this, direction, Eigen::Vector3d::Zero());
    bounds[side] = prove(simplex.solve(start(direction), 0x1p-50 * guess, every), direction, usable);
    if (!std::isfinite(bounds[side].bound) || !bounds[side].residual.allFinite()) return false;
    largest_bound = std::max(largest_bound, bounds[side].bound);
    residual = std::max(residual, taxicab3(bounds[side].residual));
  }
  if (residual > 0.25) return false;
  const double largest = largest_bound / (1 - residual) * (1 + 0x1p-50);
  for (std::size_t side = 0; side < box_sides; ++side) {
    const double rest = taxicab3(bounds[side].residual) * largest * (1 + 0x1p-50) + kSmallestNormal;
    offset_[usable + side] = add_up(bounds[side].bound, rest);
  }
  for (std::size_t k = 0; k < 3; ++k)
    max_abs_[static_cast<int>(k)] = std::max({0.0, offset_[usable + k], offset_[usable + k + 3]});
  return true;
}

double HalfSpaces::radius_up() const {
  return norm_up(max_abs_);
}

HalfSpaces::Basis HalfSpaces::start(const Eigen::Vector3d& direction) const {
  Basis basis;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    basis.sides[axis] = size() - box_sides + axis + (direction[k] < 0 ? 3 : 0);
    basis.weights[k] = std::abs(direction[k]);
  }
  return basis;
}

// Uses only half-spaces with an index below `usable`. The sums are off by at most 4.01 U of their terms,
// where U = 2^-53. The error bound of 8 U also covers the rounding of its own addition.
HalfSpaces::DualBound HalfSpaces::prove(const Basis& basis, const Eigen::Vector3d& direction,
                                        std::size_t usable) const {
  Eigen::Vector3d rest = direction, terms = direction.cwiseAbs();
  double sum = 0, magnitude = 0;
  for (int k = 0; k < 3; ++k) {
    const std::size_t i = basis.sides[static_cast<std::size_t>(k)];
    const double weight = basis.weights[k];
    if (i >= usable || weight == 0) continue;
    sum += weight * offset_[i];
    magnitude += weight * std::abs(offset_[i]);
    const Eigen::Vector3d part = weight * normal(i);
    rest -= part;
    terms += part.cwiseAbs();
  }
  return {sum + (0x1p-50 * magnitude + kSmallestNormal), rest.cwiseAbs() + 0x1p-50 * terms};
}

double HalfSpaces::bound(const Basis& basis, const Eigen::Vector3d& direction) const {
  const auto [dual_bound, residual] = prove(basis, direction, size());
  const double rest = dot3(residual, max_abs_) * (1 + 0x1p-50) + kSmallestNormal;
  return dual_bound + rest + 0x1p-51 * (std::abs(dual_bound) + rest);
}

// First uses only the half-spaces at the vertex, which suffice unless rounding hides a short edge. Otherwise
// uses all.
double HalfSpaces::support_value_up(const Eigen::Vector3d& direction, const Eigen::Vector3d& vertex) const {
  const double extent = std::max({max_abs_[0], max_abs_[1], max_abs_[2]});
  const double tolerance = 0x1p-51 * extent;
  const DualSimplex simplex(*this, direction, vertex);
  const std::vector<std::size_t> tight = simplex.tight(0x1p-34 * extent);
  const auto near = [&](const auto& visit) {
    for (const std::size_t i : tight)
      visit(i);
  };
  const Basis local = simplex.solve(start(direction), tolerance, near);
  const double first = bound(local, direction);
  if (first - dot3(direction, vertex) <= 0x1p-49 * extent) return first;
  const auto every = [&](const auto& visit) {
    for (std::size_t i = 0; i < size(); ++i)
      visit(i);
  };
  return std::min(first, bound(simplex.solve(local, tolerance, every), direction));
}

}  // namespace pcl_bv::detail
