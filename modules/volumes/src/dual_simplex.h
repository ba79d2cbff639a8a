// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the support of a convex polytope by a linear program in three variables.
//
// Weak duality proves bounds of the support value. The polytope is n_i . q <= offset_i for all i. Weights w_i
// >= 0 with sum w_i n_i = d - r prove d . q <= sum w_i offset_i + r . q for every q of the polytope. The
// proof holds for any weights >= 0. Therefore, the search computes in plain double. Its callers prove the
// bound.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace pcl_bv::detail {

/// Normals of half-spaces normal . q <= offset, one array per component. Violations are compared without
/// dividing by lengths, so the largest component of a normal should be about 1 in magnitude.
struct Normals {
  std::vector<double> x, y, z;

  void reserve(std::size_t count) {
    for (std::vector<double>* v : {&x, &y, &z})
      v->reserve(count);
  }
  void push_back(const Eigen::Vector3d& normal) {
    x.push_back(normal[0]);
    y.push_back(normal[1]);
    z.push_back(normal[2]);
  }
  std::size_t size() const { return x.size(); }
  Eigen::Vector3d operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  double projection(std::size_t i, const Eigen::Vector3d& q) const {
    return (x[i] * q[0] + y[i] * q[1]) + z[i] * q[2];
  }
};

/// Returns the largest power of two that is at most m, but at least 2^-1000 and at most 2^1000. Here m is the
/// magnitude of the largest component of the normal.
double power_of_two(const Eigen::Vector3d& normal);

/// Three half-spaces. Up to rounding, direction = sum of weights[k] * normals[sides[k]], with weights >= 0.
struct DualBasis {
  std::array<std::size_t, 3> sides;
  Eigen::Vector3d weights;
  Eigen::Vector3d corner = {};  ///< Intersection of the three planes, computed by solve().
};

/// The dual simplex method (Lemke 1954), which maximizes direction . q. The members refer to the caller's
/// data. Offsets lose no digits if they are relative to a point near the sought corner.
struct DualSimplex {
  const Normals& normals;
  const std::vector<double>& offsets;
  const Eigen::Vector3d& direction;

  /// Returns the basis of a parallelepiped, which is the intersection of the half-spaces sides[k] and
  /// sides[k] + opposite. Their normals must be opposite vectors, and linearly independent for k = 0, 1, 2.
  DualBasis start(const std::array<std::size_t, 3>& sides, std::size_t opposite) const;

  /// Improves the basis until its corner exceeds no half-space by more than absolute + relative * |corner|_1.
  /// If `candidates` is not null, only half-spaces with these indices enter the basis.
  DualBasis solve(DualBasis basis, double absolute, double relative,
                  const std::vector<std::size_t>* candidates = nullptr) const;
};

}  // namespace pcl_bv::detail
