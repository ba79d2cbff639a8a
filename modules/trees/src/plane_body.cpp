// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Bounds are proven by weak duality. Let n be the normals of planes and w >= 0 weights of the planes. If the
// sum of w n is equal to d up to a residual r, then
//   d . p <= sum of w offset + |r|_1 |p|
// for every p of the body, however inaccurate the search for the weights was. Here |p| is the largest
// absolute coordinate of p, and |n| that of n. contains() and intersect() also accept points beyond a plane
// by less than 2^-46 |n| |p|, so the error bound has the sum of w 2^-46 |n| in addition.
//
// Six bounds along the axes then bound |p| itself. If all are at most B, with an error of at most e |p|, then
//   |p| <= B + e |p|, so |p| <= 2 B.

#include "plane_body.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv {
namespace {

constexpr std::size_t kFences = 6;
// Largest accepted error bound, relative to |p|. A larger error bound means nearly parallel planes. Then the
// vertex is ill-conditioned and its bound is useless.
constexpr double kMaxErrorBound = 0x1p-26;

double max_abs(const Eigen::Vector3d& v) {
  return v.cwiseAbs().maxCoeff();
}

}  // namespace

PlaneBody::PlaneBody(const Kdop& kdop) {
  if (!add_fences(kdop.aabb())) return;
  for (std::size_t i = 0; i < kdop.size(); ++i) {
    add(kdop.set()->direction(i), kdop.max(i));
    add(-kdop.set()->direction(i), -kdop.min(i));
  }
  prove_box();
}

PlaneBody::PlaneBody(const Hull& hull) {
  if (!add_fences(hull.aabb())) return;
  for (const HullPlane& plane : hull.planes())
    add(plane.normal, plane.offset);
  prove_box();
}

// Adds the fences, which are the sides of a box around the expected body, with a margin. The search starts
// from them. Returns false if the expected body is empty.
bool PlaneBody::add_fences(const Aabb& about) {
  if (about.empty()) return false;
  origin_ = about.center();
  const double margin = (about.max() - about.min()).sum() + 0x1p-30 * max_abs(origin_) + 0x1p-900;
  for (int k = 0; k < 3; ++k) {
    add(Eigen::Vector3d::Unit(k), about.max()[k] + margin);
    add(-Eigen::Vector3d::Unit(k), margin - about.min()[k]);
  }
  return true;
}

void PlaneBody::add(const Eigen::Vector3d& normal, double offset) {
  if (normal.isZero(0)) return;  // bounds nothing
  planes_.push_back({normal, offset});
  local_offsets_.push_back(Expansion().add(offset).add_dot(-normal, origin_).value());
}

// Returns the plane that a point violates most, or nothing. Skips the fences, because no bound may rest on
// them and a vertex beyond the fences can be proven as well.
std::optional<std::size_t> PlaneBody::most_violated(const Eigen::Vector3d& point) const {
  const double tolerance = 0x1p-44 * taxicab3(point);
  std::optional<std::size_t> side;
  double worst = 0;
  for (std::size_t i = kFences; i < planes_.size(); ++i) {
    const Eigen::Vector3d& n = planes_[i].normal;
    const double length = norm3(n);
    const double excess = (dot3(n, point) - local_offsets_[i]) / length - tolerance;
    if (excess > worst) {
      worst = excess;
      side = i;
    }
  }
  return side;
}

// Finds three planes, and weights >= 0 with which their normals sum to `direction`, by the dual simplex method
// (Lemke 1954). The weights have this property, up to rounding, after every step, so the search may stop at any
// step. The limit on the number of steps ends a possible cycle.
PlaneBody::PlaneVertex PlaneBody::optimal_vertex(const Eigen::Vector3d& direction) const {
  PlaneVertex vertex{{}, direction.cwiseAbs()};
  for (std::size_t k = 0; k < 3; ++k)
    vertex.planes[k] = 2 * k + (direction[static_cast<Eigen::Index>(k)] < 0 ? 1 : 0);
  for (std::size_t step = 0; step < 4 * planes_.size(); ++step) {
    Eigen::Matrix3d normals;
    Eigen::Vector3d offsets;
    for (int k = 0; k < 3; ++k) {
      const std::size_t side = vertex.planes[static_cast<std::size_t>(k)];
      normals.row(k) = planes_[side].normal.transpose();
      offsets[k] = local_offsets_[side];
    }
    const Eigen::Matrix3d inverse = normals.inverse();
    const std::optional<std::size_t> side = most_violated(inverse * offsets);
    if (!side) break;
    // The comparison scales all normals to length 1, because otherwise long normals would hide short ones.
    const Eigen::Vector3d component = inverse.transpose() * planes_[*side].normal,
                          of_units = component.cwiseProduct(normals.rowwise().norm());
    Eigen::Index leaving = 0;
    const double change =
        (of_units.array() > 0x1p-40 * max_abs(of_units))
            .select(vertex.weights.cwiseQuotient(component), Eigen::Vector3d::Constant(kInfinity))
            .minCoeff(&leaving);
    if (change == kInfinity) break;
    vertex.weights = (vertex.weights - change * component).cwiseMax(0.0);
    vertex.weights[leaving] = change;
    vertex.planes[static_cast<std::size_t>(leaving)] = *side;
  }
  return vertex;
}

PlaneBody::Proof PlaneBody::prove(const Eigen::Vector3d& direction) const {
  const PlaneVertex vertex = optimal_vertex(direction);
  Expansion bound, error_bound;
  std::array<Expansion, 3> residual;
  for (std::size_t k = 0; k < 3; ++k)
    residual[k].add(direction[static_cast<Eigen::Index>(k)]);
  for (std::size_t i = 0; i < 3; ++i) {
    const double weight = vertex.weights[static_cast<Eigen::Index>(i)];
    if (vertex.planes[i] < kFences || weight == 0) continue;
    const HullPlane& plane = planes_[vertex.planes[i]];
    bound.add_product(weight, plane.offset).add(multiply_up(weight, kSmallestNormal));
    error_bound.add(multiply_up(weight, 0x1p-46 * max_abs(plane.normal)));
    for (std::size_t k = 0; k < 3; ++k)
      residual[k].add_product(-weight, plane.normal[static_cast<Eigen::Index>(k)]);
  }
  for (const Expansion& part : residual)
    error_bound.add(part.magnitude_up());
  return {bound.up(), error_bound.up()};
}

void PlaneBody::prove_box() {
  std::array<Proof, 6> proofs;  // along x, y, z, then -x, -y, -z
  double largest = 0;
  for (std::size_t i = 0; i < proofs.size(); ++i) {
    proofs[i] = prove((i < 3 ? 1 : -1) * Eigen::Vector3d::Unit(static_cast<int>(i % 3)));
    largest = std::max(largest, std::abs(proofs[i].bound));
    if (!(proofs[i].error_bound <= kMaxErrorBound && 2 * largest < kInfinity)) return;
  }
  const auto upper_bound = [&](const Proof& proof) {
    return add_up(proof.bound, multiply_up(proof.error_bound, 2 * largest));
  };
  const Aabb box(-Eigen::Vector3d(upper_bound(proofs[3]), upper_bound(proofs[4]), upper_bound(proofs[5])),
                 {upper_bound(proofs[0]), upper_bound(proofs[1]), upper_bound(proofs[2])});
  // An empty box proves that no point is in all half-spaces. No box is stored then, because contains() may
  // still accept points by rounding.
  if (!box.empty()) box_ = box;
}

double PlaneBody::support_bound_up(const Eigen::Vector3d& direction) const {
  if (!box_) return kInfinity;
  const Proof proof = prove(direction);
  if (!(proof.error_bound <= kMaxErrorBound * taxicab3(direction))) return kInfinity;
  const double size = std::max(max_abs(box_->min()), max_abs(box_->max()));
  return add_up(proof.bound, multiply_up(proof.error_bound, size));
}

std::optional<Aabb> PlaneBody::box() const {
  return box_;
}

}  // namespace pcl_bv
