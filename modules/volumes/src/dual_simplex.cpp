// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "dual_simplex.h"

#include <algorithm>
#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {
namespace {

// The three normals of a basis and their cross products. crosses[k] / determinant is column k of the inverse
// of the matrix whose rows are the normals.
struct Frame {
  Frame(const Normals& all, const std::array<std::size_t, 3>& sides) {
    for (std::size_t k = 0; k < 3; ++k)
      normals[k] = all[sides[k]];
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
  bool exchange(const Eigen::Vector3d& normal, std::size_t entering, DualBasis& basis) const {
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

// Returns the index of the half-space that the corner exceeds most, or size() if the corner exceeds none by
// more than `worst`.
std::size_t most_violated(const DualSimplex& simplex, const Eigen::Vector3d& corner, double worst,
                          const std::vector<std::size_t>* candidates) {
  const Normals& normals = simplex.normals;
  std::size_t found = normals.size();
  const auto visit = [&](std::size_t i) {
    const double excess = normals.projection(i, corner) - simplex.offsets[i];
    if (!(excess > worst)) return;
    worst = excess;
    found = i;
  };
  if (candidates) {
    std::for_each(candidates->begin(), candidates->end(), visit);
  } else {
    for (std::size_t i = 0; i < normals.size(); ++i)
      visit(i);
  }
  return found;
}

// Returns direction - sum of weights[k] * normals[k].
Eigen::Vector3d residual(const Frame& frame, const Eigen::Vector3d& direction,
                         const Eigen::Vector3d& weights) {
  Eigen::Vector3d rest = direction;
  for (int k = 0; k < 3; ++k)
    rest -= weights[k] * frame.normals[static_cast<std::size_t>(k)];
  return rest;
}

// Corrects the weights by their residual. The weights need a correction, because rounding errors of the steps
// add up, and nearly parallel normals of neighbouring faces amplify these errors. For bodies of 200
// half-spaces and directions of length 1, the residual is at most 3e-14 before and 2e-15 after the
// correction. If the normals are so nearly dependent that a correction makes the residual larger, the weights
// stay as they are.
void refine(const Frame& frame, const Eigen::Vector3d& direction, Eigen::Vector3d& weights) {
  Eigen::Vector3d rest = residual(frame, direction, weights);
  for (int round = 0; round < 2; ++round) {
    const Eigen::Vector3d more = frame.components(rest);
    Eigen::Vector3d corrected;
    for (int k = 0; k < 3; ++k)
      corrected[k] = std::max(0.0, weights[k] + more[k]);
    const Eigen::Vector3d remaining = residual(frame, direction, corrected);
    if (!(taxicab3(remaining) < taxicab3(rest))) return;
    weights = corrected;
    rest = remaining;
  }
}

}  // namespace

double power_of_two(const Eigen::Vector3d& normal) {
  const double largest = std::max({std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2])});
  return std::ldexp(1.0, std::clamp(std::ilogb(largest), -1000, 1000));
}

DualBasis DualSimplex::start(const std::array<std::size_t, 3>& sides, std::size_t opposite) const {
  const Eigen::Vector3d weights = Frame(normals, sides).components(direction);
  DualBasis basis{sides, weights.cwiseAbs()};
  for (std::size_t k = 0; k < 3; ++k) {
    if (weights[static_cast<int>(k)] < 0) basis.sides[k] += opposite;
  }
  return basis;
}

// Each step replaces one of the three half-spaces by the half-space that the corner violates most, such that
// the weights stay >= 0. Up to rounding, no step makes the proven bound larger. The limit of 60 steps ends
// the search if the steps repeat a cycle. After 60 steps, the weights prove a valid but less tight bound.
DualBasis DualSimplex::solve(DualBasis basis, double absolute, double relative,
                             const std::vector<std::size_t>* candidates) const {
  for (int step = 0;; ++step) {
    const auto& [a, b, c] = basis.sides;
    const Frame frame(normals, basis.sides);
    basis.corner = frame.corner_at({offsets[a], offsets[b], offsets[c]});
    const double tolerance = absolute + relative * taxicab3(basis.corner);
    const std::size_t entering = most_violated(*this, basis.corner, tolerance, candidates);
    if (step < 60 && entering < normals.size() && frame.exchange(normals[entering], entering, basis))
      continue;
    refine(frame, direction, basis.weights);
    return basis;
  }
}

}  // namespace pcl_bv::detail
