// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/capsule.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bounds.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/volumes/cylinder.h"
#include "pcl_bv/volumes/sphere.h"
#include "ring_mesh.h"

namespace pcl_bv {

using namespace detail;

namespace {

// Returns the distance of a point from a segment. q is the point and e is the second end of the segment, both
// relative to the first end. An error in the position of the nearest point of the segment increases the
// result by less than this error.
double distance_to_segment(const Eigen::Vector3d& q, const Eigen::Vector3d& e) {
  const double length = e.stableNorm();
  if (length == 0) return q.stableNorm();
  const Eigen::Vector3d unit = e / length;
  return (q - std::clamp(dot3(q, unit), 0.0, length) * unit).stableNorm();
}

void unite(const std::optional<RayInterval>& part, std::optional<RayInterval>& all) {
  if (!part) return;
  all = all ? RayInterval{std::min(all->enter, part->enter), std::max(all->exit, part->exit)} : *part;
}

}  // namespace

Capsule::Capsule() : a_(Eigen::Vector3d::Constant(kNan)), b_(a_), radius_(-1) {}

Capsule::Capsule(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius) : Capsule() {
  const FloatEnvironment environment;
  if (radius < 0) return;
  if (!a.allFinite() || !b.allFinite() || !std::isfinite(radius)) {
    throw std::invalid_argument(
        "Capsule: a, b and radius must be finite (or the radius negative, for an empty capsule)");
  }
  a_ = a.array() + 0.0;
  b_ = b.array() + 0.0;
  radius_ = radius + 0.0;
}

// Let U = 2^-53. Rounding moves q and e by at most U of their size, and the foot of the perpendicular by less
// than 12 U (|q| + |e|). Rounding changes the distance by at most the sum of these errors plus 6 U of the
// distance. Near the surface, the distance is about the radius, so the tolerance of 32 U (|q|_1 + |e|_1 +
// radius) exceeds the total error.
bool Capsule::contains(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  if (empty()) return false;
  const Eigen::Vector3d q = point - a_, e = b_ - a_;
  const double size = taxicab3(q) + taxicab3(e);
  return distance_to_segment(q, e) <= radius_ + (0x1p-48 * (size + radius_) + kSmallestNormal) &&
         point.allFinite();
}

double Capsule::volume() const {
  const FloatEnvironment environment;
  if (empty()) return 0;
  return product_of(std::numbers::pi * radius_, radius_, (b_ - a_).stableNorm() + 4 * radius_ / 3);
}

double Capsule::surface_area() const {
  const FloatEnvironment environment;
  return empty() ? 0 : 2 * std::numbers::pi * radius_ * ((b_ - a_).stableNorm() + 2 * radius_);
}

Eigen::Vector3d Capsule::center() const {
  const FloatEnvironment environment;
  return a_ + (b_ - a_) / 2;
}

Eigen::Vector3d Capsule::support(const Eigen::Vector3d& direction) const {
  const FloatEnvironment environment;
  const Eigen::Vector3d d = unit_vector(direction);
  const double ahead = dot3(d, b_ - a_);
  return (ahead == 0 ? center() : ahead > 0 ? b_ : a_) + radius_ * d;
}

double Capsule::distance(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  if (point.hasNaN()) return kNan;
  if (empty() || !point.allFinite()) return kInfinity;
  if (contains(point)) return 0;
  return std::max(0.0, distance_to_segment(point - a_, b_ - a_) - radius_);
}

std::optional<RayInterval> Capsule::intersect(const Eigen::Vector3d& origin,
                                              const Eigen::Vector3d& direction) const {
  const FloatEnvironment environment;
  if (empty() || !origin.allFinite() || !direction.allFinite()) return std::nullopt;
  // The inflated radius covers the rounding error of the axis; contains() has a similar tolerance.
  const double size = (b_ - a_).lpNorm<1>() + radius_;
  const double inflated = radius_ + 0x1p-46 * size + kSmallestNormal;
  std::optional<RayInterval> all;
  unite(Sphere(a_, inflated).intersect(origin, direction), all);
  unite(Sphere(b_, inflated).intersect(origin, direction), all);
  if (a_ != b_) {
    const double half = (b_ - a_).stableNorm() / 2;
    unite(Cylinder(center(), b_ - a_, inflated, half * (1 + 0x1p-48)).intersect(origin, direction), all);
  }
  if (contains(origin)) unite(RayInterval{0, all ? all->exit : 0}, all);
  return all;
}

Aabb Capsule::aabb() const {
  if (empty()) return {};
  return Sphere(a_, radius_).aabb().merge(Sphere(b_, radius_).aabb());
}

Mesh Capsule::mesh() const {
  const FloatEnvironment environment;
  if (empty()) return {};
  constexpr int sides = 24, steps = 6;  // `steps` rings from the equator of a half sphere to near its pole
  const bool is_sphere = a_ == b_;
  const Triad triad(is_sphere ? Eigen::Vector3d(Eigen::Vector3d::UnitZ()) : unit_vector(b_ - a_));
  std::vector<Ring> rings;
  for (int i = 1 - steps; i < steps; ++i) {
    const double angle = std::numbers::pi / 2 * std::abs(i) / steps;
    const Eigen::Vector3d rise = (i < 0 ? -1 : 1) * std::sin(angle) * radius_ * triad.axis;
    if (i <= 0) rings.push_back({a_ + rise, radius_ * std::cos(angle)});
    if (i > 0 || (i == 0 && !is_sphere)) rings.push_back({b_ + rise, radius_ * std::cos(angle)});
  }
  return ring_mesh(rings, triad, sides);
}

Capsule Capsule::transformed(const Eigen::Isometry3d& transform) const {
  const FloatEnvironment environment;
  if (empty()) return {};
  const PointWithError a = transform_point(transform, a_), b = transform_point(transform, b_);
  const double radius =
      add_up(multiply_up(radius_, matrix_norm_up(transform.linear())), std::max(a.error, b.error));
  return {a.point, b.point, radius};
}

bool operator==(const Capsule& a, const Capsule& b) {
  const FloatEnvironment environment;
  if (a.empty() || b.empty()) return a.empty() && b.empty();
  return a.a() == b.a() && a.b() == b.b() && a.radius() == b.radius();
}

}  // namespace pcl_bv
