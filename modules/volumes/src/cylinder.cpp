// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/cylinder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "bounds.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "ray_clip.h"
#include "ring_mesh.h"

namespace pcl_bv {

using namespace detail;

namespace {

// The components of a vector q from the centre, parallel and perpendicular to the axis.
struct AxisComponents {
  double along;           // q . axis
  Eigen::Vector3d cross;  // q x axis, whose length is the distance of q from the axis
};

AxisComponents axis_components(const Eigen::Vector3d& axis, const Eigen::Vector3d& q) {
  return {dot3(q, axis), q.cross(axis)};
}

// Returns the vector unchanged if its squared length differs from 1 by at most 2^-50, otherwise normalised.
// This ensures that a vector that was normalised once never changes again.
Eigen::Vector3d unit_axis(const Eigen::Vector3d& v) {
  const Eigen::Vector3d unit = std::abs(dot3(v, v) - 1) <= 0x1p-50 ? v : unit_vector(v);
  return unit.array() + 0.0;
}

}  // namespace

Cylinder::Cylinder()
    : center_(Eigen::Vector3d::Constant(kNan)),
      axis_(Eigen::Vector3d::UnitZ()),
      radius_(-1),
      half_height_(-1) {}

Cylinder::Cylinder(const Eigen::Vector3d& center, const Eigen::Vector3d& axis, double radius,
                   double half_height)
    : Cylinder() {
  const FloatEnvironment environment;
  if (radius < 0 || half_height < 0) return;
  if (!center.allFinite() || !axis.allFinite() || axis.isZero(0) || !std::isfinite(radius) ||
      !std::isfinite(half_height)) {
    throw std::invalid_argument(
        "Cylinder: center, axis, radius and half_height must be finite, the axis not zero "
        "(or the radius or half_height negative, for an empty cylinder)");
  }
  center_ = center.array() + 0.0;
  axis_ = unit_axis(axis);
  radius_ = radius + 0.0;
  half_height_ = half_height + 0.0;
}

// Error bounds, with U = 2^-53. Each component of q is off by at most U of itself, `along` by at most 5 U
// |q|_1 and each component of `cross` by at most 6 U |q|_1. Therefore the length of `cross` changes by at
// most 11 U |q|_1. Computing the length adds 4 U of the length; the deviation of |axis| from 1 adds another 4
// U of the length. The tolerance of 32 U |q|_1 exceeds all sums of these errors.
bool Cylinder::contains(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  if (empty()) return false;
  const Eigen::Vector3d q = point - center_;
  const auto [along, cross] = axis_components(axis_, q);
  const double error_bound = 0x1p-48 * taxicab3(q) + kSmallestNormal;
  return std::abs(along) <= half_height_ + error_bound && cross.stableNorm() <= radius_ + error_bound &&
         point.allFinite();
}

double Cylinder::volume() const {
  const FloatEnvironment environment;
  return empty() ? 0 : product_of(2 * std::numbers::pi * radius_, radius_, half_height_);
}

double Cylinder::surface_area() const {
  const FloatEnvironment environment;
  return empty() ? 0 : 2 * std::numbers::pi * radius_ * (radius_ + 2 * half_height_);
}

Eigen::Vector3d Cylinder::support(const Eigen::Vector3d& direction) const {
  const FloatEnvironment environment;
  const Eigen::Vector3d d = unit_vector(direction);
  // The cross products are accurate even if d is nearly parallel to the axis. For such a d, the difference d
  // - (d . axis) axis would be rounding noise in any direction.
  const Eigen::Vector3d perpendicular = cross3(axis_, cross3(d, axis_));
  return center_ + (dot3(d, axis_) < 0 ? -half_height_ : half_height_) * axis_ +
         radius_ * unit_vector(perpendicular);
}

double Cylinder::distance(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  if (point.hasNaN()) return kNan;
  if (empty() || !point.allFinite()) return kInfinity;
  if (contains(point)) return 0;
  const auto [along, cross] = axis_components(axis_, point - center_);
  return Eigen::Vector2d(std::max(0.0, std::abs(along) - half_height_),
                         std::max(0.0, cross.stableNorm() - radius_))
      .stableNorm();
}

// The rounding error of a point of the ray grows with the point's distance from the ray's origin. For points
// inside the cylinder, this distance is bounded in terms of |q|, half_height and the radius. So the ends of
// the ray's part inside the cylinder are off by less than `error_bound`: half of it covers the positions, the
// other half the square roots. The ray is clipped by a cylinder that is inflated by `error_bound`, so the
// result encloses the exact part.
std::optional<RayInterval> Cylinder::intersect(const Eigen::Vector3d& origin,
                                               const Eigen::Vector3d& direction) const {
  return intersect_ray(*this, origin, direction, [&](RayClip& ray) {
    const auto [exponent, u] = ScaledDirection(direction);
    const Eigen::Vector3d q = origin - center_;
    const double error_bound = 0x1p-44 * (q.lpNorm<1>() + half_height_ + radius_) + kSmallestNormal;
    const bool held = contains(origin);
    const auto [along, cross] = axis_components(axis_, q);
    const auto [step, step_cross] = axis_components(axis_, u);
    const double height = std::max(half_height_, held ? std::abs(along) : 0) + error_bound;
    const double slope_error_bound = 0x1p-48 * u.lpNorm<1>();
    RayClip scaled;
    scaled.keep(step - slope_error_bound, height - along);
    scaled.keep(-step - slope_error_bound, height + along);
    const double radius = std::max(radius_, held ? cross.stableNorm() : 0) + error_bound;
    const double speed = step_cross.stableNorm();
    if (speed > 0) {
      const double nearest = -dot3(cross / speed, step_cross / speed);
      const double h = (cross + nearest * step_cross).stableNorm();
      scaled.keep_within_radius(nearest, h, radius, speed, 0);
    } else if (cross.stableNorm() > radius) {
      return ray.keep(0, -1);
    }
    const auto found = scaled.interval();
    if (!found) return ray.keep(0, -1);
    ray.keep_between(std::ldexp(found->enter, -exponent), std::ldexp(found->exit, -exponent));
  });
}

// |axis| differs from 1 by at most 2^-50, so each half extent is off by at most 2^-49 (half_height + radius).
Aabb Cylinder::aabb() const {
  const FloatEnvironment environment;
  if (empty()) return {};
  Eigen::Vector3d inflated;
  for (int i = 0; i < 3; ++i) {
    const double a = axis_[i], b = axis_[(i + 1) % 3], c = axis_[(i + 2) % 3];
    const double half = half_height_ * std::abs(a) + radius_ * std::sqrt(b * b + c * c);
    inflated[i] = half + 0x1p-47 * (half_height_ + radius_) + kSmallestNormal;
  }
  return box_around(center_, inflated);
}

Mesh Cylinder::mesh() const {
  const FloatEnvironment environment;
  if (empty()) return {};
  return ring_mesh({{center_ - half_height_ * axis_, radius_}, {center_ + half_height_ * axis_, radius_}},
                   Triad(axis_), 48);
}

// Let w be the new axis, `length` = |M axis| and e the small error M axis - length w. A point center + s axis
// + v, with v perpendicular to the axis, moves to the new centre + s (length w + e) + M v. The projection of
// M v on w equals the projection of v on M' w. M' w is `length` times the old axis plus a small error. Since
// v is perpendicular to the old axis, only the projection of v on this error is not 0. `back` bounds this
// projection.
Cylinder Cylinder::transformed(const Eigen::Isometry3d& transform) const {
  const FloatEnvironment environment;
  if (empty()) return {};
  const Eigen::Matrix3d m = transform.linear();
  const PointWithError center = transform_point(transform, center_);
  const Eigen::Vector3d rotated = m * axis_;
  const Eigen::Vector3d axis = unit_axis(rotated);
  const double length = rotated.stableNorm();
  const double e = multiply_up(half_height_ * (1 + 0x1p-49), difference_up(m, axis_, length, axis));
  const double back = multiply_up(radius_ * (1 + 0x1p-49), difference_up(m.transpose(), axis, length, axis_));
  const double moved = add_up(center.error, e);
  const double radius = add_up(multiply_up(radius_, matrix_norm_up(m)), moved);
  const double height = add_up(multiply_up(half_height_, length), add_up(moved, back));
  return {center.point, axis, multiply_up(radius, 1 + 0x1p-48), multiply_up(height, 1 + 0x1p-48)};
}

FloatCylinder Cylinder::cast_float() const {
  const FloatEnvironment environment;
  const Eigen::Vector3f none = Eigen::Vector3f::Constant(static_cast<float>(kNan));
  if (empty()) return {none, none, -1.0F};
  constexpr double limit = std::numeric_limits<float>::max();
  const Eigen::Vector3f center = center_.cwiseMax(-limit).cwiseMin(limit).cast<float>();
  const Eigen::Vector3f axis = axis_.cast<float>();
  const double moved = distance_up(center_, center.cast<double>());
  const double rotated = multiply_up(2 * half_height_, distance_up(axis_, axis.cast<double>()));
  return {center, axis, float_up((radius_ + moved + rotated) * (1 + 1e-12))};
}

bool operator==(const Cylinder& a, const Cylinder& b) {
  const FloatEnvironment environment;
  if (a.empty() || b.empty()) return a.empty() && b.empty();
  return a.center() == b.center() && a.axis() == b.axis() && a.radius() == b.radius() &&
         a.half_height() == b.half_height();
}

}  // namespace pcl_bv
