// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Exact predicates. First, double arithmetic with a rigorous error bound accepts nearly all points that are
// inside. Then rational arithmetic decides the other points.

#include "pcl_bv/fitting/fit.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/point_source.h"
#include "schedule.h"

namespace pcl_bv {
using namespace detail;
namespace {

using Rational = boost::multiprecision::cpp_rational;

using ExactVector = std::array<Rational, 3>;

ExactVector exact(const Eigen::Vector3d& v) {
  return {Rational(v.x()), Rational(v.y()), Rational(v.z())};
}

ExactVector difference(const ExactVector& a, const ExactVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// Converts an exact excess to the distance excess / scale. The result is 0 only if the excess is not
// positive, which means that the point is inside.
double excess_distance(const Rational& excess, double scale) {
  if (excess <= 0) return 0.0;
  return std::max(static_cast<double>(excess) / scale, std::numeric_limits<double>::denorm_min());
}

double violation(const Aabb& box, const Eigen::Vector3d& p) {
  if ((p.array() >= box.min().array()).all() && (p.array() <= box.max().array()).all()) return 0.0;
  double worst = 0;
  for (int axis = 0; axis < 3; ++axis) {
    worst = std::max(worst, excess_distance(Rational(box.min()[axis]) - Rational(p[axis]), 1.0));
    worst = std::max(worst, excess_distance(Rational(p[axis]) - Rational(box.max()[axis]), 1.0));
  }
  return worst;
}

// Returns an upper bound of the rounding error of n . p in double arithmetic.
double dot_error(const Eigen::Vector3d& n, const Eigen::Vector3d& p) {
  return 8 * kUnitRoundoff * dot3(n.cwiseAbs(), p.cwiseAbs()) + kSmallestNormal;
}

double violation(const Kdop& kdop, const Eigen::Vector3d& p) {
  double worst = 0;
  for (std::size_t k = 0; k < kdop.size(); ++k) {
    const Eigen::Vector3d& n = kdop.set()->direction(k);
    const double rounded = dot3(n, p), bound = dot_error(n, p);
    if (rounded - bound >= kdop.min(k) && rounded + bound <= kdop.max(k)) continue;
    const Rational along = dot3(exact(n), exact(p));
    worst = std::max(worst, excess_distance(Rational(kdop.min(k)) - along, n.norm()));
    worst = std::max(worst, excess_distance(along - Rational(kdop.max(k)), n.norm()));
  }
  return worst;
}

double violation(const Sphere& sphere, const Eigen::Vector3d& p) {
  const Eigen::Vector3d q = p - sphere.center();
  const double squared = dot3(q, q);
  const double r = sphere.radius();
  if (squared * (1 + 16 * kUnitRoundoff) + kSmallestNormal <= r * r * (1 - 16 * kUnitRoundoff)) return 0.0;
  Rational excess = -Rational(r) * Rational(r);
  for (int axis = 0; axis < 3; ++axis) {
    const Rational difference = Rational(p[axis]) - Rational(sphere.center()[axis]);
    excess += difference * difference;
  }
  if (excess <= 0) return 0.0;
  return std::max(std::sqrt(squared) - r, std::numeric_limits<double>::denorm_min());
}

double violation(const Obb& box, const Eigen::Vector3d& p) {
  const Eigen::Vector3d q = p - box.center();
  const double bound = 8 * kUnitRoundoff * taxicab3(q) + kSmallestNormal;
  double worst = 0;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d a = box.axis(i);
    const double rounded = dot3(a, q);
    if (std::abs(rounded) + bound <= box.half_extents()[i]) continue;
    Rational exact = 0;
    for (int k = 0; k < 3; ++k)
      exact += Rational(a[k]) * (Rational(p[k]) - Rational(box.center()[k]));
    const Rational limit(box.half_extents()[i]);
    worst = std::max(worst, excess_distance((exact < 0 ? Rational(-exact) : exact) - limit, 1.0));
  }
  return worst;
}

double violation(const Hull& hull, const Eigen::Vector3d& p) {
  double worst = 0;
  for (const HullPlane& plane : hull.planes()) {
    const Eigen::Vector3d& n = plane.normal;
    const double rounded = dot3(n, p), bound = dot_error(n, p);
    if (rounded + bound <= plane.offset) continue;
    const Rational along = dot3(exact(n), exact(p));
    worst = std::max(worst, excess_distance(along - Rational(plane.offset), n.norm()));
  }
  return worst;
}

// Tests the half-plane of the edge from a to b. Returns 0 if the point is inside, otherwise its distance from
// the edge's line. `u`, `v` and `bound` are the rounded coordinates and their error bound.
double violation(const Prism& prism, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                 const Eigen::Vector3d& p, double u, double v, double bound) {
  const double x = b.x() - a.x(), y = b.y() - a.y();
  const double left = x * (v - a.y()), right = y * (u - a.x());
  const double error = 0x1p-50 * (std::abs(left) + std::abs(right)) +
                       2 * (std::abs(x) + std::abs(y)) * bound + kSmallestNormal;
  if (left - right >= error) return 0.0;
  const ExactVector at = exact(p);
  const Rational edge_x = Rational(b.x()) - Rational(a.x()), edge_y = Rational(b.y()) - Rational(a.y());
  const Rational along_u = dot3(exact(prism.axes().col(0)), at) - Rational(a.x());
  const Rational along_v = dot3(exact(prism.axes().col(1)), at) - Rational(a.y());
  return excess_distance(Rational(edge_y * along_u - edge_x * along_v), std::hypot(x, y));
}

// Returns 0 if the point is inside an outline that is not convex, otherwise its distance from the nearest
// edge. Where the point is nearer to an edge than rounding allows to decide, the even-odd rule is computed
// exactly.
double polygon_violation(const Prism& prism, const Eigen::Vector3d& p, double u, double v, double bound) {
  const std::vector<Eigen::Vector2d>& outline = prism.outline();
  std::optional<Rational> exact_u, exact_v;
  const auto locate = [&] {
    if (exact_u) return;
    exact_u = dot3(exact(prism.axes().col(0)), exact(p));
    exact_v = dot3(exact(prism.axes().col(1)), exact(p));
  };
  const auto exactly_left = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    locate();
    const Rational left = (Rational(b.x()) - Rational(a.x())) * (*exact_v - Rational(a.y()));
    return Rational(left - (Rational(b.y()) - Rational(a.y())) * (*exact_u - Rational(a.x()))).sign();
  };
  const auto is_below = [&](double low) {  // whether `low` is at most the exact v
    if (std::abs(v - low) > 2 * bound) return low < v;
    locate();
    return Rational(low) <= *exact_v;
  };
  bool inside = false;
  double nearest = kInfinity;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d &a = outline[i], &b = outline[i + 1 < outline.size() ? i + 1 : 0];
    const Eigen::Vector2d edge = b - a, from = Eigen::Vector2d(u, v) - a;
    const double left = edge.x() * from.y(), right = edge.y() * from.x();
    const double error = 0x1p-50 * (std::abs(left) + std::abs(right)) +
                         2 * (std::abs(edge.x()) + std::abs(edge.y())) * bound + kSmallestNormal;
    const bool is_clear = std::abs(left - right) > error;
    const int side = is_clear ? (left > right ? 1 : -1) : exactly_left(a, b);
    const auto between = [&](int axis) {  // exact, because the point is on the line of the edge
      const Rational& at = axis == 0 ? *exact_u : *exact_v;
      return at >= Rational(std::min(a[axis], b[axis])) && at <= Rational(std::max(a[axis], b[axis]));
    };
    if (side == 0 && between(0) && between(1)) return 0.0;
    if (is_below(a.y()) != is_below(b.y()) && (side > 0) == (b.y() > a.y())) inside = !inside;
    // 0 if it underflows: the edge is then treated as its first end.
    const double squared = edge.squaredNorm();
    const double along = squared > 0 ? std::clamp(edge.dot(from) / squared, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (from - along * edge).norm());
  }
  return inside ? 0.0 : std::max(nearest, std::numeric_limits<double>::denorm_min());
}

// The half-planes of one or two corners do not bound the outline, but its box does.
double violation(const Prism& prism, const Eigen::Vector3d& p) {
  const std::vector<Eigen::Vector2d>& outline = prism.outline();
  Eigen::Vector3d low(outline[0].x(), outline[0].y(), prism.low());
  Eigen::Vector3d high(outline[0].x(), outline[0].y(), prism.high());
  for (const Eigen::Vector2d& corner : outline) {
    low.head<2>() = low.head<2>().cwiseMin(corner);
    high.head<2>() = high.head<2>().cwiseMax(corner);
  }
  double worst = 0;
  Eigen::Vector3d rounded, bounds;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d n = prism.axes().col(i);
    rounded[i] = dot3(n, p);
    bounds[i] = dot_error(n, p);
    if (rounded[i] - bounds[i] >= low[i] && rounded[i] + bounds[i] <= high[i]) continue;
    const Rational along = dot3(exact(n), exact(p));
    worst = std::max(worst, excess_distance(Rational(low[i]) - along, 1.0));
    worst = std::max(worst, excess_distance(along - Rational(high[i]), 1.0));
  }
  if (!prism.is_convex())
    return std::max(worst, polygon_violation(prism, p, rounded[0], rounded[1], bounds.head<2>().maxCoeff()));
  if (outline.size() < 2) return worst;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& next = outline[i + 1 < outline.size() ? i + 1 : 0];
    worst = std::max(
        worst, violation(prism, outline[i], next, p, rounded[0], rounded[1], bounds.head<2>().maxCoeff()));
  }
  return worst;
}

// Let U = 2^-53. q = p - center has a relative error of U, and the axis has about length 1. The errors of
// q . axis and of |q x axis|, including the error of the axis' length, are below 32 U |q|_1.
double violation(const Cylinder& cylinder, const Eigen::Vector3d& p) {
  const Eigen::Vector3d q = p - cylinder.center();
  const Eigen::Vector3d& axis = cylinder.axis();
  const double along = std::abs(q.dot(axis)), across = q.cross(axis).stableNorm();
  const double error_bound = 32 * kUnitRoundoff * taxicab3(q) + kSmallestNormal;
  const double r = cylinder.radius(), h = cylinder.half_height();
  if (along + error_bound <= h && across + error_bound <= r) return 0.0;
  const ExactVector exact_q = difference(exact(p), exact(cylinder.center())), a = exact(axis);
  const Rational squared_axis = dot3(a, a), projection = dot3(exact_q, a), squared = projection * projection;
  const bool too_far = squared > Rational(h) * Rational(h) * squared_axis;
  // |q x a|^2 = |q|^2 |a|^2 - (q . a)^2
  const bool too_wide =
      dot3(exact_q, exact_q) * squared_axis - squared > Rational(r) * Rational(r) * squared_axis;
  if (!too_far && !too_wide) return 0.0;
  return std::max({along - h, across - r, std::numeric_limits<double>::denorm_min()});
}

double violation(const Capsule& capsule, const Eigen::Vector3d& p) {
  const double r = capsule.radius();
  const Eigen::Vector3d q = p - capsule.a(), e = capsule.b() - capsule.a();
  const double length = e.stableNorm();
  const Eigen::Vector3d unit = length > 0 ? Eigen::Vector3d(e / length) : Eigen::Vector3d::Zero();
  const double far = (q - std::clamp(q.dot(unit), 0.0, length) * unit).stableNorm();
  if (far + 64 * kUnitRoundoff * (taxicab3(q) + taxicab3(e)) + kSmallestNormal <= r) return 0.0;
  const ExactVector a = exact(capsule.a()), edge = difference(exact(capsule.b()), a);
  const ExactVector from_a = difference(exact(p), a);
  const Rational squared_edge = dot3(edge, edge);
  Rational foot = squared_edge > 0 ? Rational(dot3(from_a, edge) / squared_edge) : Rational(0);
  foot = foot < 0 ? Rational(0) : foot > 1 ? Rational(1) : foot;
  ExactVector away;
  for (std::size_t i = 0; i < 3; ++i)
    away[i] = from_a[i] - foot * edge[i];
  if (dot3(away, away) <= Rational(r) * Rational(r)) return 0.0;
  return std::max(far - r, std::numeric_limits<double>::denorm_min());
}

double violation(const Ellipsoid& ellipsoid, const Eigen::Vector3d& p) {
  const Eigen::Vector3d q = p - ellipsoid.center();
  const Eigen::Vector3d& radii = ellipsoid.radii();
  const double error_bound = 16 * kUnitRoundoff * taxicab3(q) + kSmallestNormal;
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double ratio = (std::abs(q.dot(ellipsoid.axes().col(i))) + error_bound) / radii[i];
    sum += ratio * ratio;
  }
  if (sum <= 1 - 16 * kUnitRoundoff) return 0.0;
  const ExactVector exact_q = difference(exact(p), exact(ellipsoid.center()));
  Rational exact_sum = 0;
  bool off_plane = false;
  for (int i = 0; i < 3; ++i) {
    const Rational along = dot3(exact_q, exact(ellipsoid.axes().col(i)));
    if (radii[i] == 0) {
      off_plane = off_plane || along != 0;
    } else {
      const Rational ratio = along / Rational(radii[i]);
      exact_sum += ratio * ratio;
    }
  }
  if (!off_plane && exact_sum <= 1) return 0.0;
  return std::max(ellipsoid.distance(p), std::numeric_limits<double>::denorm_min());
}

void merge(Verification& all, const Verification& part) {
  all.checked += part.checked;
  all.outside += part.outside;
  all.max_violation = std::max(all.max_violation, part.max_violation);
}

template <typename Volume>
Verification verify_chunk(const Volume& volume, const PointView& points) {
  Verification result;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) continue;
    ++result.checked;
    const double out = volume.empty() ? kInfinity : violation(volume, Eigen::Vector3d(p.x, p.y, p.z));
    if (out > 0) ++result.outside;
    result.max_violation = std::max(result.max_violation, out);
  }
  return result;
}

}  // namespace

Verification verify(const AnyVolume& volume, const PointView& points, const Execution& execution) {
  const FloatEnvironment environment;
  constexpr std::size_t chunk_points = 4096;  // small, because a point can take 1 us in rational arithmetic
  const auto check = [&](std::size_t chunk) {
    const std::size_t begin = chunk * chunk_points;
    const LoadedPoints part(points, begin, std::min(chunk_points, points.count - begin));
    return std::visit([&part](const auto& shape) { return verify_chunk(shape, part.view()); }, volume);
  };
  return reduce_chunks(worthwhile(execution, Work::verify, points.count),
                       (points.count + chunk_points - 1) / chunk_points, Verification{}, check, merge);
}

}  // namespace pcl_bv
