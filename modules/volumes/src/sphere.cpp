// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/sphere.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "bounds.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/coordinates.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/power_of_two.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/volumes/ray_through_sphere.h"
#include "ray_clip.h"

namespace pcl_bv {

using namespace detail;

namespace {

// A total order of spheres, larger radius first, so that merge() is commutative.
bool precedes(const Sphere& a, const Sphere& b) {
  if (a.radius() != b.radius()) return a.radius() > b.radius();
  return std::lexicographical_compare(a.center().begin(), a.center().end(), b.center().begin(),
                                      b.center().end());
}

// Returns the smallest sphere around two spheres. Neither may enclose the other. The radius is the larger of
// the distances from the rounded centre to the far sides of the two spheres. Each step is rounded up, so the
// result encloses both spheres in spite of the rounding error of the centre.
Sphere around(const Sphere& big, const Sphere& small) {
  const Eigen::Vector3d step = small.center() - big.center();
  const double d = step.stableNorm();
  const double part = std::clamp(((d - big.radius()) + small.radius()) / (2 * d), 0.0, 1.0);
  const Eigen::Vector3d center = big.center() + part * step;
  const auto far_side = [&](const Sphere& s) { return add_up(distance_up(center, s.center()), s.radius()); };
  return {center, std::max(far_side(big), far_side(small))};
}

// Returns an upper limit for the computed squared distance d2 of two points a and b. If the exact distance |a
// - b| is at most r, d2 is at most this limit, in spite of rounding. In units of 2^-53, the relative errors
//   are 1 for each component of q = a - b, at most 5 for d2, and at most 3 for the limit. If r is itself a
//   rounded sum, the error of the limit is at most 5. The margin of 16 units covers all of these errors.
double square_within_rounding(double r) {
  return r * r * (1 + 0x1p-49) + kSmallestNormal;
}

bool within_rounding(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double r) {
  const Eigen::Vector3d q = a - b;
  return dot3(q, q) <= square_within_rounding(r);
}

// Returns |v| without overflow or underflow, by dividing by the largest component first. Sizes whose inverse
// could overflow or lose digits are first scaled by a power of two.
double safe_norm3(const Coordinates& v) {
  const double size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(size > 0 && size < kInfinity)) return size;
  if (!(size > 0x1p-1000 && size < 0x1p1000)) {
    const int exponent = size < 1 ? 500 : -500;
    const auto scaled = [&](double x) { return times_power_of_two(x, exponent); };
    return times_power_of_two(safe_norm3({scaled(v.x), scaled(v.y), scaled(v.z)}), -exponent);
  }
  const double inverse = 1 / size;
  return size * norm3(Coordinates{v.x * inverse, v.y * inverse, v.z * inverse});
}

// Clips the ray to an interval around the point P of the ray's line that is nearest to the centre. P is
// computed in double. Let q = origin - center and U = 2^-53. The position of P is off by at most 4 U |q|, and
// the distance h of P from the centre by another 9 U |q|. Along the line, P is at most 8 U |q|_1 from the
// exact foot of the perpendicular. A radius that is larger by 52 U |q|_1 covers these errors. A radius that
// is larger by 64 U |q|_1 also covers the rounding of this radius.
void clip_by_sphere(RayClip& ray, const Eigen::Vector3d& center, double radius, const Eigen::Vector3d& origin,
                    const Eigen::Vector3d& direction) {
  const auto [exponent, u] = ScaledDirection(direction);
  // Coordinates, because Eigen loads two doubles at once, which waits for the two stores before.
  const Coordinates q = {origin[0] - center[0], origin[1] - center[1], origin[2] - center[2]};
  const double square = dot3(u, u), nearest = -dot3(q, u) / square;
  const double h = safe_norm3({q.x + nearest * u[0], q.y + nearest * u[1], q.z + nearest * u[2]});
  const double error_bound = 0x1p-47 * taxicab3(q) + kSmallestNormal;
  const double held = dot3(q, q) <= square_within_rounding(radius) ? safe_norm3(q) : 0;
  ray.keep_within_radius(nearest, h, std::max(radius, held) + error_bound, std::sqrt(square), exponent);
}

}  // namespace

std::optional<RayInterval> detail::intersect_sphere(const Eigen::Vector3d& center, double radius,
                                                    const Eigen::Vector3d& origin,
                                                    const Eigen::Vector3d& direction) {
  RayClip ray;
  clip_by_sphere(ray, center, radius, origin, direction);
  return ray.interval();
}

Sphere::Sphere() : center_(Eigen::Vector3d::Constant(kNan)), radius_(-1) {}

Sphere::Sphere(const Eigen::Vector3d& center, double radius) : Sphere() {
  const FloatEnvironment environment;
  if (radius < 0) return;
  if (!center.allFinite() || !std::isfinite(radius)) {
    throw std::invalid_argument(
        "Sphere: center and radius must be finite (or the radius negative, for an empty sphere)");
  }
  center_ = center.array() + 0.0;
  radius_ = radius + 0.0;
}

bool Sphere::contains(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  return !empty() && within_rounding(point, center_, radius_) && point.allFinite();
}

double Sphere::max_squared_distance() const {
  return empty() ? -1 : square_within_rounding(radius_);
}

double Sphere::volume() const {
  const FloatEnvironment environment;
  return empty() ? 0 : 4 * std::numbers::pi / 3 * radius_ * radius_ * radius_;
}

double Sphere::surface_area() const {
  const FloatEnvironment environment;
  return empty() ? 0 : 4 * std::numbers::pi * radius_ * radius_;
}

Eigen::Vector3d Sphere::support(const Eigen::Vector3d& direction) const {
  const FloatEnvironment environment;
  return center_ + radius_ * unit_vector(direction);
}

double Sphere::distance(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  if (point.hasNaN()) return kNan;
  if (empty() || !point.allFinite()) return kInfinity;
  if (contains(point)) return 0;
  return std::max(0.0, (point - center_).stableNorm() - radius_);
}

std::optional<RayInterval> Sphere::intersect(const Eigen::Vector3d& origin,
                                             const Eigen::Vector3d& direction) const {
  return intersect_ray(*this, origin, direction,
                       [&](RayClip& ray) { clip_by_sphere(ray, center_, radius_, origin, direction); });
}

bool Sphere::overlaps(const Sphere& other) const {
  const FloatEnvironment environment;
  return within_rounding(center_, other.center_, radius_ + other.radius_);  // false if either is empty
}

Aabb Sphere::aabb() const {
  const FloatEnvironment environment;
  return empty() ? Aabb() : box_around(center_, Eigen::Vector3d::Constant(radius_));
}

Sphere Sphere::transformed(const Eigen::Isometry3d& transform) const {
  const FloatEnvironment environment;
  if (empty()) return {};
  const PointWithError center = transform_point(transform, center_);
  return {center.point, add_up(multiply_up(radius_, matrix_norm_up(transform.linear())), center.error)};
}

Sphere& Sphere::extend(const Eigen::Vector3d& point) {
  return point.allFinite() ? merge({point, 0.0}) : *this;
}

Sphere& Sphere::merge(const Sphere& other) {
  const FloatEnvironment environment;
  if (other.empty()) return *this;
  if (empty()) return *this = other;
  const bool this_first = precedes(*this, other);
  const Sphere big = this_first ? *this : other;
  const Sphere small = this_first ? other : *this;
  return *this = ball_inside_ball(small.center_, big.center_, big.radius_, small.radius_)
                     ? big
                     : around(big, small);
}

FloatSphere Sphere::cast_float() const {
  const FloatEnvironment environment;
  if (empty()) return {Eigen::Vector3f::Constant(static_cast<float>(kNan)), -1.0f};
  constexpr double limit = std::numeric_limits<float>::max();
  const Eigen::Vector3f center = center_.cwiseMax(-limit).cwiseMin(limit).cast<float>();
  return {center, float_up(add_up(radius_, distance_up(center_, center.cast<double>())))};
}

bool operator==(const Sphere& a, const Sphere& b) {
  const FloatEnvironment environment;
  if (a.empty() || b.empty()) return a.empty() && b.empty();
  return a.center() == b.center() && a.radius() == b.radius();
}

}  // namespace pcl_bv
