// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/ellipsoid.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bounds.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "ray_clip.h"

namespace pcl_bv {

using namespace detail;

Ellipsoid::Ellipsoid()
    : center_(Eigen::Vector3d::Constant(kNan)),
      axes_(Eigen::Matrix3d::Identity()),
      radii_(Eigen::Vector3d::Constant(-1)) {}

Ellipsoid::Ellipsoid(const Eigen::Vector3d& center, const Eigen::Matrix3d& axes, const Eigen::Vector3d& radii)
    : Ellipsoid() {
  const FloatEnvironment environment;
  if ((radii.array() < 0).any()) return;
  if (!center.allFinite() || !radii.allFinite() || !(orthonormality_error(axes) <= 1e-12)) {
    throw std::invalid_argument(
        "Ellipsoid: center and radii must be finite and the axes orthonormal to 1e-12 "
        "(or any radius negative, for an empty ellipsoid)");
  }
  center_ = center.array() + 0.0;
  axes_ = axes.array() + 0.0;
  radii_ = radii.array() + 0.0;
}

// Each axis . q is off by at most 5 U |q|_1, where U = 2^-53. The quotients, squares and the sum add a
// relative error of 6 U.
bool Ellipsoid::contains(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  const Eigen::Vector3d q = point - center_;
  const double error_bound = 0x1p-49 * taxicab3(q) + kSmallestNormal;
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double along = std::max(0.0, std::abs(dot3(axes_.col(i), q)) - error_bound);
    if (!(along <= radii_[i] * (1 + 0x1p-48))) return false;  // also for an empty ellipsoid: radii are -1
    const double ratio = along > 0 ? along / radii_[i] : 0;
    sum += ratio * ratio;
  }
  return sum <= 1 + 0x1p-48 && point.allFinite();
}

double Ellipsoid::volume() const {
  const FloatEnvironment environment;
  return empty() ? 0 : product_of(4 * std::numbers::pi / 3 * radii_[0], radii_[1], radii_[2]);
}

Eigen::Vector3d Ellipsoid::support(const Eigen::Vector3d& direction) const {
  const FloatEnvironment environment;
  const Eigen::Vector3d d = unit_vector(direction);
  Eigen::Vector3d stretched;
  for (int i = 0; i < 3; ++i)
    stretched[i] = radii_[i] * dot3(axes_.col(i), d);
  const Eigen::Vector3d unit = unit_vector(stretched);
  return center_ + axes_ * radii_.cwiseProduct(unit);
}

// The ray is clipped in coordinates in which the ellipsoid is the unit sphere. In these coordinates, points
// of the ray up to its exit are off by less than `error_bound` divided by the smallest radius. The sphere is
// inflated by this quotient.
std::optional<RayInterval> Ellipsoid::intersect(const Eigen::Vector3d& origin,
                                                const Eigen::Vector3d& direction) const {
  return intersect_ray(*this, origin, direction, [&](RayClip& ray) {
    const auto [exponent, u] = ScaledDirection(direction);
    const Eigen::Vector3d q = origin - center_;
    const double largest = radii_.maxCoeff();
    const double error_bound = 0x1p-45 * (taxicab3(q) + largest) + kSmallestNormal;
    // Radii below this limit are raised to it. With a lower limit, the quotient of `error_bound` and the
    // smallest radius would be larger. The other radii of a flat ellipsoid would then be inflated by more.
    const double thin = std::max(error_bound, std::sqrt(error_bound * largest));
    Eigen::Vector3d at, step;
    for (int i = 0; i < 3; ++i) {
      const double radius = std::max(radii_[i], thin);
      at[i] = dot3(axes_.col(i), q) / radius;
      step[i] = dot3(axes_.col(i), u) / radius;
    }
    const double radius = 1 + error_bound / std::max(radii_.minCoeff(), thin) +
                          (contains(origin) ? std::max(0.0, at.stableNorm() - 1) : 0.0);
    const double speed = step.stableNorm();
    const double nearest = -dot3(at, step / speed) / speed;
    const double h = (at + nearest * step).stableNorm();
    ray.keep_within_radius(nearest, h, radius, speed, exponent);
  });
}

// The ellipsoid is the unit ball transformed by N^-1 diag(radii), where N is the transpose of `axes_`. The
// code uses `axes_` instead of N^-1. Each row of the difference is shorter than 4 *
// orthonormality_error(axes_), and `margin` covers this.
Aabb Ellipsoid::aabb() const {
  const FloatEnvironment environment;
  if (empty()) return {};
  const double margin = (4 * orthonormality_error(axes_) + 0x1p-48) * radii_.maxCoeff() + kSmallestNormal;
  Eigen::Vector3d half;
  for (int i = 0; i < 3; ++i)
    half[i] = Eigen::Vector3d(axes_.row(i).transpose().cwiseProduct(radii_)).stableNorm() + margin;
  return box_around(center_, half);
}

// Let e be the rounding error of the new centre, a'_i the new axes and d_i = M' a'_i - a_i. A point center +
// q has the new coordinates a'_i . (M q + e) = a_i . q + d_i . q + a'_i . e. The sum of the last two terms is
// at most extra_i. Therefore, it suffices to multiply all radii by the factor 1 + |(extra_i / radius_i)|.
Ellipsoid Ellipsoid::transformed(const Eigen::Isometry3d& transform) const {
  const FloatEnvironment environment;
  if (empty()) return {};
  const Eigen::Matrix3d m = transform.linear();
  const PointWithError center = transform_point(transform, center_);
  const double largest = radii_.maxCoeff();
  Eigen::Matrix3d axes;
  axes.col(0) = (m * axes_.col(0)).stableNormalized();
  axes.col(1) = m * axes_.col(1);
  axes.col(1) = (axes.col(1) - dot3(axes.col(0), axes.col(1)) * axes.col(0)).stableNormalized();
  axes.col(2) = axes.col(0).cross(axes.col(1)) * (m.determinant() * axes_.determinant() < 0 ? -1 : 1);
  Eigen::Vector3d extra;
  for (int i = 0; i < 3; ++i) {
    const double rotated = difference_up(m.transpose(), axes.col(i), 1, axes_.col(i));
    extra[i] = (rotated * largest + center.error) * (1 + 0x1p-30);
  }
  const double smallest = std::max(0x1p-30 * largest, extra.maxCoeff());
  const Eigen::Vector3d radii = radii_.cwiseMax(smallest);
  double growth = 1;
  if (smallest > 0) growth = 1 + extra.cwiseQuotient(radii).stableNorm();
  return {center.point, axes, radii * (growth * (1 + 0x1p-48))};
}

bool operator==(const Ellipsoid& a, const Ellipsoid& b) {
  const FloatEnvironment environment;
  if (a.empty() || b.empty()) return a.empty() && b.empty();
  return a.center() == b.center() && a.axes() == b.axes() && a.radii() == b.radii();
}

}  // namespace pcl_bv
