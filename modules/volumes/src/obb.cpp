// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Obb's arithmetic, compiled here so that the user's compiler flags cannot change it. Which way its axes are
// named is in obb_orientation.cpp.
#include "pcl_bv/volumes/obb.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "directed.h"
#include "ray_clip.h"
#include "special_values.h"
#include "vector3.h"

namespace pcl_bv {

using namespace volumes_internal;

namespace {

constexpr double orthonormal_to = 1e-12;

// axis . q in double. q is itself a rounded difference: with it, three products and two sums, the value is
// off by at most 4.01 2^-53 of |q|_1; the bound is twice that, and covers its own addition.
struct Component {
  double value, error;
};

Component component(const Eigen::Vector3d& axis, const Eigen::Vector3d& q) {
  return {dot(axis, q), 0x1p-50 * taxicab(q) + smallest_normal};
}

// a . b exactly, and with c: a . (b - c).
ExactSum exact_dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  ExactSum sum;
  for (int k = 0; k < 3; ++k)
    sum.add_product(a[k], b[k]);
  return sum;
}

double greatest(const ExactSum& sum) {
  return std::max(sum.up(), -sum.down());
}

bool are_orthonormal(const Eigen::Matrix3d& axes) {
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      if (!(std::abs(dot(axes.col(i), axes.col(j)) - (i == j)) <= orthonormal_to)) return false;
    }
  }
  return true;
}

}  // namespace

Obb::Obb()
    : center_(Eigen::Vector3d::Constant(nan)),
      axes_(Eigen::Matrix3d::Identity()),
      half_extents_(Eigen::Vector3d::Constant(-1)) {}

Obb::Obb(const Eigen::Vector3d& center, const Eigen::Matrix3d& axes, const Eigen::Vector3d& half_extents)
    : Obb() {
  if ((half_extents.array() < 0).any()) return;
  if (!center.allFinite() || !half_extents.allFinite() || !are_orthonormal(axes)) {
    throw std::invalid_argument(
        "Obb: center and half extents must be finite (or a half extent negative, for an empty box), and "
        "axes unit and orthogonal to 1e-12");
  }
  center_ = center.array() + 0.0;
  axes_ = axes;
  if (dot(axes.col(0).cross(axes.col(1)), axes.col(2)) < 0) axes_.col(2) = -axes_.col(2);
  axes_.array() += 0.0;
  half_extents_ = half_extents.array() + 0.0;
}

Obb::Obb(const Aabb& box) : Obb(from_slabs(Eigen::Matrix3d::Identity(), box.min(), box.max())) {}

Obb Obb::from_slabs(const Eigen::Matrix3d& axes, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return from_slabs(axes, Eigen::Vector3d::Zero(), low, high);
}

Obb Obb::from_slabs(const Eigen::Matrix3d& axes, const Eigen::Vector3d& origin, const Eigen::Vector3d& low,
                    const Eigen::Vector3d& high) {
  if ((low.array() > high.array()).any()) return {};
  const Eigen::Vector3d middle = low + 0.5 * (high - low);
  Eigen::Vector3d center = origin;
  // A second time for what the axes lack of being orthogonal.
  for (int round = 0; round < 2; ++round) {
    Eigen::Vector3d missing;
    for (int i = 0; i < 3; ++i)
      missing[i] = middle[i] - dot(axes.col(i), center - origin);
    center += (axes.col(0) * missing[0] + axes.col(1) * missing[1]) + axes.col(2) * missing[2];
  }
  Eigen::Vector3d half_extents;
  for (int i = 0; i < 3; ++i) {
    ExactSum at = exact_dot(axes.col(i), center);
    for (int k = 0; k < 3; ++k)
      at.add_product(-axes(k, i), origin[k]);
    half_extents[i] = std::max({0.0, -ExactSum(at).add(-high[i]).down(), at.add(-low[i]).up()});
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
  const Eigen::Vector3d q = point - center_;
  for (int i = 0; i < 3; ++i) {
    const auto [s, error] = component(axes_.col(i), q);
    if (!(std::abs(s) <= half_extents_[i] + error)) return false;  // an empty one is nowhere: NaN
  }
  return true;
}

double Obb::volume() const {
  return empty() ? 0 : (2 * half_extents_.x()) * (2 * half_extents_.y()) * (2 * half_extents_.z());
}

double Obb::surface_area() const {
  const Eigen::Vector3d& h = half_extents_;
  return empty() ? 0 : 8 * (h.x() * h.y() + h.y() * h.z() + h.z() * h.x());
}

Eigen::Vector3d Obb::support(const Eigen::Vector3d& direction) const {
  Eigen::Vector3d corner = center_;
  for (int i = 0; i < 3; ++i)
    corner += (dot(axes_.col(i), direction) < 0 ? -half_extents_[i] : half_extents_[i]) * axes_.col(i);
  return corner;
}

double Obb::distance(const Eigen::Vector3d& point) const {
  if (point.hasNaN()) return nan;
  if (empty()) return infinity;
  if (contains(point)) return 0;
  const Eigen::Vector3d q = point - center_;
  Eigen::Vector3d excess;
  for (int i = 0; i < 3; ++i)
    excess[i] = std::max(0.0, std::abs(dot(axes_.col(i), q)) - half_extents_[i]);
  return excess.stableNorm();
}

std::optional<RayInterval> Obb::intersect(const Eigen::Vector3d& origin,
                                          const Eigen::Vector3d& direction) const {
  return intersect_ray(*this, origin, direction, [&](RayClip& ray) {
    const Eigen::Vector3d q = origin - center_;
    for (int i = 0; i < 3; ++i) {
      const Component start = component(axes_.col(i), q), step = component(axes_.col(i), direction);
      ray.keep(step.value - 2 * step.error, half_extents_[i] - (start.value - 2 * start.error));
      ray.keep(-(step.value + 2 * step.error), half_extents_[i] + (start.value + 2 * start.error));
    }
  });
}

std::array<Eigen::Vector3d, 8> Obb::corners() const {
  std::array<Eigen::Vector3d, 8> result;
  for (unsigned i = 0; i < 8; ++i) {
    result[i] = center_;
    for (int k = 0; k < 3; ++k)
      result[i] += (i >> k & 1 ? half_extents_[k] : -half_extents_[k]) * axes_.col(k);
    if (empty()) result[i].setConstant(nan);
  }
  return result;
}

// With w = A y + r, where y_i = axis(i) . w as rounded and r is what that lacks: w . q is at most
// sum |y_i| h_i + |r| |q|, and |q| at most 1.001 |h|_1.
double Obb::reach_up(const Eigen::Vector3d& direction) const {
  Eigen::Vector3d y;
  double reach = 0;
  for (int i = 0; i < 3; ++i) {
    y[i] = dot(axes_.col(i), direction);
    reach = add_up(reach, multiply_up(std::abs(y[i]), half_extents_[i]));
  }
  Eigen::Vector3d lacking;
  for (int k = 0; k < 3; ++k) {
    ExactSum sum;
    sum.add(-direction[k]);
    for (int i = 0; i < 3; ++i)
      sum.add_product(axes_(k, i), y[i]);
    lacking[k] = greatest(sum);
  }
  if (lacking.isZero(0)) return reach;
  return add_up(reach, multiply_up(1.001 * half_extents_.sum(), norm_up(lacking)));
}

Aabb Obb::aabb() const {
  if (empty()) return {};
  Eigen::Vector3d lower, upper;
  for (int k = 0; k < 3; ++k) {
    const double reach = reach_up(Eigen::Vector3d::Unit(k));
    lower[k] = -add_up(-center_[k], reach);
    upper[k] = add_up(center_[k], reach);
  }
  return {lower, upper};
}

Mesh Obb::mesh() const {
  if (empty()) return {};
  Mesh mesh = Aabb(-half_extents_, half_extents_).mesh();
  const std::array<Eigen::Vector3d, 8> c = corners();
  std::copy(c.begin(), c.end(), mesh.vertices.begin());
  return mesh;
}

// a' . (M p + t - c') = (M' a') . (p - c) + a' . (M c + t - c').
Obb Obb::transformed(const Eigen::Isometry3d& transform) const {
  if (empty()) return {};
  const Eigen::Matrix3d m = transform.linear();
  const Eigen::Matrix3d axes = orthonormal_axes(m * axes_);
  const Eigen::Vector3d center = transform * center_;
  Eigen::Vector3d moved;
  for (int k = 0; k < 3; ++k)
    moved[k] = greatest(exact_dot(m.row(k).transpose(), center_).add(transform(k, 3)).add(-center[k]));
  Eigen::Vector3d half_extents;
  for (int i = 0; i < 3; ++i) {
    Eigen::Vector3d w, rounding;
    for (int k = 0; k < 3; ++k) {
      const ExactSum exact = exact_dot(m.col(k), axes.col(i));
      w[k] = exact.value();
      rounding[k] = greatest(ExactSum(exact).add(-w[k]));
    }
    const double lost = add_up(multiply_up(1.001 * half_extents_.sum(), norm_up(rounding)),
                               multiply_up(1.001, norm_up(moved)));
    half_extents[i] = add_up(reach_up(w), lost);
  }
  return {center, axes, half_extents};
}

FloatObb Obb::cast_float() const {
  FloatObb result;
  result.axes = axes_.cast<float>();
  constexpr double limit = std::numeric_limits<float>::max();
  result.center = center_.cwiseMax(-limit).cwiseMin(limit).cast<float>();
  result.half_extents.setConstant(-1);
  if (empty()) {
    result.center.setConstant(static_cast<float>(nan));
    return result;
  }
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = result.axes.col(i).cast<double>();
    ExactSum away;
    for (int k = 0; k < 3; ++k)
      away.add_product(axis[k], center_[k]).add_product(-axis[k], static_cast<double>(result.center[k]));
    result.half_extents[i] = float_up(add_up(reach_up(axis), greatest(away)));
  }
  return result;
}

bool operator==(const Obb& a, const Obb& b) {
  if (a.empty() || b.empty()) return a.empty() && b.empty();
  return a.center() == b.center() && a.axes() == b.axes() && a.half_extents() == b.half_extents();
}

}  // namespace pcl_bv
