// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The judge of fits: does a volume hold every point?
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "exact.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv::test {

// The predicates of the documentation, in rationals and independent of verify().
inline bool holds(const Aabb& box, const Coordinates& p) {
  return box.min().x() <= p.x && p.x <= box.max().x() && box.min().y() <= p.y && p.y <= box.max().y() &&
         box.min().z() <= p.z && p.z <= box.max().z();
}

inline bool holds(const Kdop& kdop, const Coordinates& p) {
  for (std::size_t k = 0; k < kdop.size(); ++k) {
    if (!exactly_between(kdop.min(k), kdop.set()->direction(k), p, kdop.max(k))) return false;
  }
  return true;
}

inline bool holds(const Sphere& sphere, const Coordinates& p) {
  return exactly_within(sphere.center(), sphere.radius(), p);
}

inline bool holds(const Obb& box, const Coordinates& p) {
  const Eigen::Vector3d& c = box.center();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d a = box.axis(i);
    const double x = a.x() * (p.x - c.x()), y = a.y() * (p.y - c.y()), z = a.z() * (p.z - c.z());
    const double terms = std::abs(x) + std::abs(y) + std::abs(z);
    if (std::abs(x + y + z) + kClearly * terms + kUnderflow < box.half_extents()[i]) continue;
    const Rational exact = exact_dot(a, p) - exact_dot(a, Coordinates{c.x(), c.y(), c.z()});
    if (abs(exact) > Rational(box.half_extents()[i])) return false;
  }
  return true;
}

inline bool holds(const Cylinder& cylinder, const Coordinates& p) {
  const ExactAlong q(cylinder.center(), cylinder.axis(), p);
  const Rational r(cylinder.radius()), h(cylinder.half_height());
  return q.along * q.along <= h * h * q.squared_axis &&
         q.squared * q.squared_axis - q.along * q.along <= r * r * q.squared_axis;
}

inline bool holds(const Capsule& capsule, const Coordinates& p) {
  using ExactEdge = std::array<Rational, 3>;
  ExactEdge edge;
  for (int k = 0; k < 3; ++k)
    edge[static_cast<std::size_t>(k)] = Rational(capsule.b()[k]) - Rational(capsule.a()[k]);
  const Rational r2 = Rational(capsule.radius()) * Rational(capsule.radius());
  Rational along = 0, squared_edge = 0;
  const double coordinates[] = {p.x, p.y, p.z};
  for (int k = 0; k < 3; ++k) {
    const Rational& e = edge[static_cast<std::size_t>(k)];
    along += (Rational(coordinates[k]) - Rational(capsule.a()[k])) * e;
    squared_edge += e * e;
  }
  if (along <= 0) return exact_squared_distance(capsule.a(), p) <= r2;
  if (along >= squared_edge) return exact_squared_distance(capsule.b(), p) <= r2;
  return exact_squared_distance(capsule.a(), p) * squared_edge - along * along <= r2 * squared_edge;
}

inline bool holds(const Ellipsoid& ellipsoid, const Coordinates& p) {
  Rational sum = 0;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = ellipsoid.axes().col(k);
    const Rational along = ExactAlong(ellipsoid.center(), axis, p).along;
    const Rational radius(ellipsoid.radii()[k]);
    if (radius == 0 && along != 0) return false;
    if (radius != 0) sum += along * along / (radius * radius);
  }
  return sum <= 1;
}

inline bool holds(const Hull& hull, const Coordinates& p) {
  for (const HullPlane& plane : hull.planes()) {
    if (!exactly_at_most(plane.normal, p, plane.offset)) return false;
  }
  return !hull.empty();
}

// The even-odd rule; the boundary is inside. Rationals decide where rounding could matter.
inline bool holds_polygon(const Prism& prism, const Coordinates& p) {
  const Eigen::Vector3d east = prism.axes().col(0), north = prism.axes().col(1);
  const RoundedDot v = rounded_dot(north, p);
  const std::vector<Eigen::Vector2d>& outline = prism.outline();
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double margin = kClearly * (v.terms + std::abs(a.y()) + std::abs(b.y())) + kUnderflow;
    if (v.value < std::min(a.y(), b.y()) - margin || v.value > std::max(a.y(), b.y()) + margin) continue;
    const Rational x = exact_dot(east, p), y = exact_dot(north, p);
    const Rational left = (Rational(b.x()) - Rational(a.x())) * (y - Rational(a.y()));
    const Rational cross = left - (Rational(b.y()) - Rational(a.y())) * (x - Rational(a.x()));
    const auto between = [](double low, const Rational& at, double high) {
      return Rational(std::min(low, high)) <= at && at <= Rational(std::max(low, high));
    };
    if (cross == 0 && between(a.x(), x, b.x()) && between(a.y(), y, b.y())) return true;
    const bool above_a = Rational(a.y()) <= y, above_b = Rational(b.y()) <= y;
    if (above_a != above_b && (cross > 0) == above_a) inside = !inside;
  }
  return inside;
}

inline bool holds(const Prism& prism, const Coordinates& p) {
  const Eigen::Vector3d east = prism.axes().col(0), north = prism.axes().col(1), up = prism.up();
  if (prism.empty() || !exactly_between(prism.low(), up, p, prism.high())) return false;
  if (!prism.is_convex()) return holds_polygon(prism, p);
  const std::vector<Eigen::Vector2d>& outline = prism.outline();
  Eigen::Vector2d low = outline[0], high = low;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
    low = low.cwiseMin(a);
    high = high.cwiseMax(a);
    const RoundedDot u = rounded_dot(east, p), v = rounded_dot(north, p);
    const double x = b.x() - a.x(), y = b.y() - a.y();
    const double left = x * (v.value - a.y()), right = y * (u.value - a.x());
    const double terms =
        std::abs(x) * (v.terms + std::abs(a.y())) + std::abs(y) * (u.terms + std::abs(a.x()));
    if (left - right > kClearly * terms + kUnderflow) continue;
    const Rational edge_x = Rational(b.x()) - Rational(a.x()), edge_y = Rational(b.y()) - Rational(a.y());
    if (edge_x * (exact_dot(north, p) - Rational(a.y())) < edge_y * (exact_dot(east, p) - Rational(a.x())))
      return false;
  }
  if (outline.size() > 2) return true;  // otherwise the half-planes leave it unbounded
  return exactly_between(low.x(), east, p, high.x()) && exactly_between(low.y(), north, p, high.y());
}

inline void expect_encloses(const AnyVolume& volume, const PointView& points) {
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) continue;
    ASSERT_TRUE(std::visit([&p](const auto& shape) { return holds(shape, p); }, volume)) << "point " << i;
    ASSERT_TRUE(contains(volume, {p.x, p.y, p.z})) << "contains() denies point " << i;
  }
}

}  // namespace pcl_bv::test
