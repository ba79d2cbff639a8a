// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A SIMD filter drops the points inside the polygon of the 26 extremal points (Akl, Toussaint 1978), usually
// most of all points. to_convex_chain() finds the corners among the other points.

#include "box/outline.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "box/obb_axes.h"
#include "box/rectangle.h"
#include "map_chunks.h"
#include "pcl_bv/kernels/half_spaces.h"
#include "same_points.h"
#include "schedule.h"

namespace pcl_bv::detail {
namespace {

Outline chunk_outline(UsableIsa isa, const PointView& chunk, const Supports& supports,
                      const HalfSpaces& inside, const LocalFrame& frame, const Ground& ground) {
  Outline outline;
  for_each_outside(isa, chunk, supports, inside,
                   [&](const Coordinates& p) { outline.push_back(ground.flat(frame.local(p))); });
  outline.resize(to_convex_chain(outline.data(), outline.size()));
  return outline;
}

}  // namespace

Eigen::Vector3d unit_up(const char* fit, const Eigen::Vector3d& up) {
  const double largest = up.cwiseAbs().maxCoeff();
  if (!up.allFinite() || !(largest >= 1e-30 && largest <= 1e30)) {
    throw std::invalid_argument(std::string(fit) +
                                ": up must be finite with its largest component from 1e-30 to 1e30");
  }
  const Eigen::Vector3d scaled = up / largest;
  return scaled / std::sqrt(scaled.squaredNorm());
}

Ground::Ground(const Eigen::Vector3d& unit_up) : up(unit_up) {
  Eigen::Index least = 0;
  up.cwiseAbs().minCoeff(&least);
  Eigen::Matrix3d frame;
  frame << up, Eigen::Vector3d::Unit(least), Eigen::Vector3d::Zero();
  frame = orthonormal_axes(frame);
  east = frame.col(1);
  north = frame.col(2);
}

Eigen::Matrix3d Ground::axes_along(const Eigen::Vector2d& side) const {
  Eigen::Matrix3d axes;
  axes << up, side.x() * east + side.y() * north, Eigen::Vector3d::Zero();
  return orthonormal_axes(axes);
}

// Returns half-spaces that a point is inside only if it is strictly inside the polygon. Therefore, the limit
// of a half-space is lowered by an error bound. Let U = 2^-53, D the extent of the cloud and l the length of
// the polygon's edge in local coordinates. The local coordinates of a corner have an error of 16 U. The unit
// normal has an error of 32 U / l, which moves a point by at most 100 U D / l against the edge. The kernel's
// rounding of a projection is below 16 units of the scalar type times D, and the rounding of the limit is
// below 64 U D. 128 units exceed the sum of the last two. The last term covers underflow.
HalfSpaces outline_half_spaces(const PointView& points, const Supports& supports, const LocalFrame& frame,
                               const Ground& ground) {
  SmallVector<Eigen::Vector2d, 32> corners;
  const FewPoints few = support_or_all_points(points, supports, frame);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : few) {
    corners.push_back(ground.flat(p));
    middle += p / static_cast<double>(few.size());
  }
  const std::size_t count = to_convex_chain(corners.data(), corners.size());
  HalfSpaces result;
  if (count < 3 || count > kMaxHalfSpaces) return result;
  const bool is_float = points.scalar == ScalarType::float32;
  Eigen::Vector3d center = frame.global(middle);
  if (is_float) center = center.cast<float>().cast<double>();
  result.center = {center.x(), center.y(), center.z()};
  const Eigen::Vector2d from = ground.flat(frame.local(result.center));
  const double unit = is_float ? 0x1p-17 : 0x1p-46, underflow = is_float ? 0x1p-140 : 0x1p-1000;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[i + 1 < count ? i + 1 : 0];
    const Eigen::Vector2d side(b.y() - a.y(), a.x() - b.x());
    const double length = std::sqrt(side.x() * side.x() + side.y() * side.y());
    const Eigen::Vector2d outward = side / length;
    const Eigen::Vector3d n = outward.x() * ground.east + outward.y() * ground.north;
    const double error_bound = frame.extent() * (unit + 0x1p-46 / length) + underflow;
    const double limit = outward.dot(a - from) / frame.scale() - error_bound;
    if (!(limit > 0)) return {};  // The polygon is so thin that all points are near the outline.
    result.planes[result.count++] = {n.x(), n.y(), n.z(), is_float ? static_cast<float>(limit) : limit};
  }
  return result;
}

Outline outline_from_above(const PointView& points, const Supports& supports, const LocalFrame& frame,
                           const Ground& ground, const FitExecution& execution) {
  const HalfSpaces inside = outline_half_spaces(points, supports, frame, ground);
  Outline outline;
  std::size_t most = std::size_t{1} << 16;
  const auto reduce = [&] { outline.resize(to_convex_chain(outline.data(), outline.size())); };
  map_chunks<Outline, 16>(
      points, worthwhile(execution, Work::outline, points.count),
      [&](const PointView& chunk) {
        return chunk_outline(execution.isa, chunk, supports, inside, frame, ground);
      },
      [&](const Outline& part) {
        for (const Eigen::Vector2d& corner : part)
          outline.push_back(corner);
        if (outline.size() <= most) return;
        reduce();
        most = std::max(most, 2 * outline.size());
      });
  require_same_points(!outline.empty());
  if (chunk_count(points.count) > 1) reduce();
  return outline;
}

}  // namespace pcl_bv::detail
