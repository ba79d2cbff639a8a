// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/obb.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "bounds.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "projection.h"
#include "ray_clip.h"

namespace pcl_bv {

using namespace detail;

namespace {

// Returns axis . q in double, with an error bound. q is itself a rounded difference. Together, the rounding
// errors of q, of three products and of two sums are at most 4.01 * 2^-53 |q|_1. The error bound is 8 * 2^-53
// |q|_1, which also covers the rounding when a caller adds the error bound.
Projection component(const Eigen::Vector3d& axis, const Eigen::Vector3d& q) {
  return {dot3(axis, q), 0x1p-50 * taxicab3(q) + kSmallestNormal};
}

// Returns the sizes in descending order, so that their products and sums have the same bits for every order
// of the axes.
Eigen::Vector3d descending(Eigen::Vector3d sizes) {
  std::sort(sizes.begin(), sizes.end(), std::greater<>());
  return sizes;
}

}  // namespace

Obb::Obb()
    : center_(Eigen::Vector3d::Constant(kNan)),
      axes_(Eigen::Matrix3d::Identity()),
      half_extents_(Eigen::Vector3d::Constant(-1)) {}

Obb::Obb(const Eigen::Vector3d& center, const Eigen::Matrix3d& axes, const Eigen::Vector3d& half_extents)
    : Obb() {
  const FloatEnvironment environment;
  if ((half_extents.array() < 0).any()) return;
  if (!center.allFinite() || !half_extents.allFinite() || !(orthonormality_error(axes) <= 1e-12)) {
    throw std::invalid_argument(
        "Obb: center and half extents must be finite (or a half extent negative, for an empty box), and "
        "axes unit and orthogonal to 1e-12");
  }
  center_ = center.array() + 0.0;
  axes_ = axes;
  if (dot3(axes.col(0).cross(axes.col(1)), axes.col(2)) < 0) axes_.col(2) = -axes_.col(2);
  axes_.array() += 0.0;
  half_extents_ = half_extents.array() + 0.0;
}

Obb::Obb(const Aabb& box) : Obb(from_slabs(Eigen::Matrix3d::Identity(), box.min(), box.max())) {}

Obb Obb::from_slabs(const Eigen::Matrix3d& axes, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return from_slabs(axes, Eigen::Vector3d::Zero(), low, high);
}

Obb Obb::from_slabs(const Eigen::Matrix3d& axes, const Eigen::Vector3d& origin, const Eigen::Vector3d& low,
                    const Eigen::Vector3d& high) {
  const FloatEnvironment environment;
  if ((low.array() > high.array()).any()) return {};
  const Eigen::Vector3d middle = low + 0.5 * (high - low);
  Eigen::Vector3d center = origin;
  // The second round corrects for axes that are not exactly orthogonal.
  for (int round = 0; round < 2; ++round) {
    Eigen::Vector3d missing;
    for (int i = 0; i < 3; ++i)
      missing[i] = middle[i] - dot3(axes.col(i), center - origin);
    center += (axes.col(0) * missing[0] + axes.col(1) * missing[1]) + axes.col(2) * missing[2];
  }
  Eigen::Vector3d half_extents;
  for (int i = 0; i < 3; ++i) {
    Expansion at;
    at.add_dot(axes.col(i), center).add_dot(-axes.col(i), origin);
    half_extents[i] = std::max({0.0, -Expansion(at).add(-high[i]).down(), at.add(-low[i]).up()});
  }
  return {center, axes, half_extents};
}

Eigen::Isometry3d Obb::pose() const {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = axes_;
  result.translation() = center_;
  return result;
}

Eigen::Quaterniond Obb::quaternion() const {
  const FloatEnvironment environment;
  Eigen::Quaterniond q(axes_);
  q.normalize();
  for (const double c : {q.w(), q.x(), q.y(), q.z()}) {
    if (c == 0) continue;
    if (c < 0) q.coeffs() = -q.coeffs();
    break;
  }
  q.coeffs().array() += 0.0;
  return q;
}

bool Obb::contains(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  const Eigen::Vector3d q = point - center_;
  for (int i = 0; i < 3; ++i) {
    const auto [s, error] = component(axes_.col(i), q);
    if (!(std::abs(s) <= half_extents_[i] + error)) return false;  // also for an empty box: s is NaN
  }
  return point.allFinite();
}

double Obb::volume() const {
  const FloatEnvironment environment;
  if (empty()) return 0;
  const Eigen::Vector3d h = descending(half_extents_);
  return product_of(2 * h.x(), 2 * h.y(), 2 * h.z());
}

double Obb::surface_area() const {
  const FloatEnvironment environment;
  if (empty()) return 0;
  const Eigen::Vector3d h = descending(half_extents_);
  return 8 * (h.x() * h.y() + h.y() * h.z() + h.z() * h.x());
}

Eigen::Vector3d Obb::support(const Eigen::Vector3d& direction) const {
  const FloatEnvironment environment;
  Eigen::Vector3d corner = center_;
  for (int i = 0; i < 3; ++i)
    corner += (dot3(axes_.col(i), direction) < 0 ? -half_extents_[i] : half_extents_[i]) * axes_.col(i);
  return corner;
}

double Obb::distance(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  if (point.hasNaN()) return kNan;
  if (empty() || !point.allFinite()) return kInfinity;
  if (contains(point)) return 0;
  const Eigen::Vector3d q = point - center_;
  Eigen::Vector3d excess;
  for (int i = 0; i < 3; ++i)
    excess[i] = std::max(0.0, std::abs(dot3(axes_.col(i), q)) - half_extents_[i]);
  return excess.stableNorm();
}

std::optional<RayInterval> Obb::intersect(const Eigen::Vector3d& origin,
                                          const Eigen::Vector3d& direction) const {
  return intersect_ray(*this, origin, direction, [&](RayClip& ray) {
    const Eigen::Vector3d q = origin - center_;
    for (int i = 0; i < 3; ++i) {
      const Projection start = component(axes_.col(i), q), step = component(axes_.col(i), direction);
      ray.keep(step.low(), half_extents_[i] - start.low());
      ray.keep(-step.high(), half_extents_[i] + start.high());
    }
  });
}

std::array<Eigen::Vector3d, 8> Obb::corners() const {
  const FloatEnvironment environment;
  std::array<Eigen::Vector3d, 8> result;
  for (unsigned i = 0; i < 8; ++i) {
    result[i] = center_;
    for (int k = 0; k < 3; ++k)
      result[i] += (i >> k & 1 ? half_extents_[k] : -half_extents_[k]) * axes_.col(k);
  }
  return result;
}

// For the direction w, let y_i = axis(i) . w, rounded, and let r = w - A y, where A is axes_; `residual`
// bounds the components of r. Let h be half_extents_. Each q = p - center of the box satisfies w . q <= sum
// |y_i| h_i + |r| |q|, with |q| <= 1.001 |h|_1.
double Obb::support_value_up(const Eigen::Vector3d& direction) const {
  Eigen::Vector3d y;
  double bound = 0;
  for (int i = 0; i < 3; ++i) {
    y[i] = dot3(axes_.col(i), direction);
    bound = add_up(bound, multiply_up(std::abs(y[i]), half_extents_[i]));
  }
  Eigen::Vector3d residual;
  for (int k = 0; k < 3; ++k)
    residual[k] = Expansion().add(-direction[k]).add_dot(axes_.row(k), y).magnitude_up();
  if (residual.isZero(0)) return bound;
  return add_up(bound, multiply_up(1.001 * half_extents_.sum(), norm_up(residual)));
}

Aabb Obb::aabb() const {
  const FloatEnvironment environment;
  if (empty()) return {};
  return box_around(center_,
                    {support_value_up(Eigen::Vector3d::UnitX()), support_value_up(Eigen::Vector3d::UnitY()),
                     support_value_up(Eigen::Vector3d::UnitZ())});
}

Mesh Obb::mesh() const {
  if (empty()) return {};
  Mesh mesh = Aabb(-half_extents_, half_extents_).mesh();
  const std::array<Eigen::Vector3d, 8> c = corners();
  std::copy(c.begin(), c.end(), mesh.vertices.begin());
  return mesh;
}

// Let the transform map p to M p + t. Let c be the old centre, c' the new centre and a' a new axis. Then a' .
// (M p + t - c') = (M' a') . (p - c) + a' . (M c + t - c'). The last term is at most 1.001 times the rounding
// error of c'.
Obb Obb::transformed(const Eigen::Isometry3d& transform) const {
  const FloatEnvironment environment;
  if (empty()) return {};
  const Eigen::Matrix3d m = transform.linear();
  const Eigen::Matrix3d axes = orthonormal_axes(m * axes_);
  const PointWithError center = transform_point(transform, center_);
  Eigen::Vector3d half_extents;
  for (int i = 0; i < 3; ++i) {
    Eigen::Vector3d w, rounding;
    for (int k = 0; k < 3; ++k) {
      Expansion exact;
      w[k] = exact.add_dot(m.col(k), axes.col(i)).value();
      rounding[k] = exact.add(-w[k]).magnitude_up();
    }
    const double lost =
        add_up(multiply_up(1.001 * half_extents_.sum(), norm_up(rounding)), multiply_up(1.001, center.error));
    half_extents[i] = add_up(support_value_up(w), lost);
  }
  return {center.point, axes, half_extents};
}

FloatObb Obb::cast_float() const {
  const FloatEnvironment environment;
  FloatObb result;
  result.axes = axes_.cast<float>();
  constexpr double limit = std::numeric_limits<float>::max();
  result.center = center_.cwiseMax(-limit).cwiseMin(limit).cast<float>();
  result.half_extents.setConstant(-1);
  if (empty()) {
    result.center.setConstant(static_cast<float>(kNan));
    return result;
  }
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = result.axes.col(i).cast<double>();
    Expansion away;
    away.add_dot(axis, center_).add_dot(-axis, result.center.cast<double>());
    result.half_extents[i] = float_up(add_up(support_value_up(axis), away.magnitude_up()));
  }
  return result;
}

bool operator==(const Obb& a, const Obb& b) {
  const FloatEnvironment environment;
  if (a.empty() || b.empty()) return a.empty() && b.empty();
  return a.center() == b.center() && a.axes() == b.axes() && a.half_extents() == b.half_extents();
}

}  // namespace pcl_bv
