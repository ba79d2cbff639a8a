// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "hull/inner_polytope.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "hull/convex_hull.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {
namespace {

struct Corners {
  std::vector<Coordinates> points;
  std::vector<Eigen::Vector3d> local;
};

Corners corners_of(const Supports& supports, const LocalFrame& frame, std::vector<Triangle>& triangles) {
  std::vector<SupportPoint> ends;
  for (std::size_t k = 0; k < direction_count(supports.set); ++k)
    ends.insert(ends.end(), {supports.along[k].low_point, supports.along[k].high_point});
  triangles = keep_extreme(ends);
  Corners corners;
  for (const SupportPoint& end : ends) {
    corners.points.push_back(end.point);
    corners.local.push_back(frame.local(end.point));
  }
  return corners;
}

// The floating-point type of the points. The kernels of half_spaces.h compute in this type.
struct Scalar {
  explicit Scalar(ScalarType type) : is_float(type == ScalarType::float32) {}

  bool is_float;
  double unit() const { return is_float ? 0x1p-24 : kUnitRoundoff; }
  double underflow_bound() const { return is_float ? 0x1p-140 : 0x1p-1000; }  // above errors of underflow

  double nearest(double x) const { return is_float ? static_cast<double>(static_cast<float>(x)) : x; }
  double down(double x) const { return is_float ? static_cast<double>(float_down(x)) : x; }

  // Returns whether squared lengths in a cloud of this extent neither overflow nor underflow.
  bool squares(double extent) const {
    return is_float ? extent > 1e-15 && extent < 1e18 : extent > 1e-140 && extent < 1e140;
  }
};

Coordinates middle(const Corners& corners, const LocalFrame& frame, const Scalar& scalar) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : corners.local)
    sum += p;
  const Eigen::Vector3d c = frame.global(sum / static_cast<double>(corners.local.size()));
  return {scalar.nearest(c.x()), scalar.nearest(c.y()), scalar.nearest(c.z())};
}

// Returns the half-space of a triangle with the corner a. Its limit is lowered by an error bound for all
// rounding. Let U = 2^-53, u the rounding unit of the scalar type, D the largest extent of the cloud, and c
// the centre. Local coordinates, which are at most 2, have errors of at most 4 U. The edges have errors of
// 12 U. The components of their cross product m have errors of 112 U, and the rounded unit normal n has an
// error of 112 U / |m| + 2 u. For a point p of the cloud, the error of n changes n . (p - a) by at most 3 D
// times this error. The kernel's rounding of n . (p - c) adds 16 u D, and the rounding of n . (a - c) adds
// 24 U D. The total is less than D (512 U / |m| + 64 u).
HalfSpace half_space(const Corners& corners, const Triangle& t, const Coordinates& center, double extent,
                     const Scalar& scalar) {
  const auto at = [&](std::size_t i) { return corners.local[static_cast<std::size_t>(t[i])]; };
  const Eigen::Vector3d m = (at(1) - at(0)).cross(at(2) - at(0));
  const double length = norm3(m);
  HalfSpace h{scalar.nearest(m.x() / length), scalar.nearest(m.y() / length), scalar.nearest(m.z() / length),
              0};
  const Coordinates& a = corners.points[static_cast<std::size_t>(t[0])];
  const double projection = (h.x * (a.x - center.x) + h.y * (a.y - center.y)) + h.z * (a.z - center.z);
  const double error_bound = extent * (0x1p-44 / length + 64 * scalar.unit()) + scalar.underflow_bound();
  // If the triangle has no area, the limit is NaN, and the caller uses no half-spaces.
  h.limit = scalar.down(projection - error_bound);
  return h;
}

}  // namespace

HalfSpaces inner_polytope(const PointView& points, const Supports& supports, const LocalFrame& frame) {
  HalfSpaces result;
  std::vector<Triangle> triangles;
  const Corners corners = corners_of(supports, frame, triangles);
  if (triangles.empty() || triangles.size() > kMaxHalfSpaces) return result;
  const Scalar scalar(points.scalar);
  result.center = middle(corners, frame, scalar);
  double ball = kInfinity;
  for (const Triangle& t : triangles) {
    const HalfSpace h = half_space(corners, t, result.center, frame.extent(), scalar);
    if (!(h.limit > 0)) return {};  // The polytope is so flat that the filter would drop few points.
    ball = std::min(ball, h.limit);
    result.planes[result.count++] = h;
  }
  // For each half-space and each point p in the ball, n . (p - c) is smaller than the limit by at least 2^-9
  // of the limit. This margin covers the rounding of the kernels.
  if (scalar.squares(frame.extent())) result.squared_ball = scalar.down(ball * ball * (1 - 0x1p-8));
  return result;
}

}  // namespace pcl_bv::detail
