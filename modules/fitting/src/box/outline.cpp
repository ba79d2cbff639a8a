// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A SIMD filter drops the points inside the polygon of the 26 extremal points (Akl, Toussaint 1978), usually
// most of all points. to_convex_chain() finds the corners among the other points.

#include "box/outline.h"

#include <algorithm>
#include <cmath>

#include "box/obb_axes.h"
#include "box/rectangle.h"
#include "map_chunks.h"
#include "pcl_bv/kernels/half_spaces.h"
#include "same_points.h"
#include "schedule.h"

namespace pcl_bv::detail {
namespace {

// Returns the vertical half-spaces through the polygon's edges. Points within a margin of a half-space's
// plane are treated as outside. The margin covers underflow and rounding errors of up to 128 rounding units
// of the extent (2^-17 for floats, 2^-46 for doubles). If rounding drops an outside point nevertheless, the
// box may be larger than the minimum. It still encloses this point, because its extents are measured on all
// points.
HalfSpaces outline_half_spaces(const PointView& points, const FewPoints& few, const LocalFrame& frame,
                               const Ground& ground) {
  SmallVector<Eigen::Vector2d, 32> corners;
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
  const double error_bound =
      frame.extent() * (is_float ? 0x1p-17 : 0x1p-46) + (is_float ? 0x1p-140 : 0x1p-1000);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[i + 1 < count ? i + 1 : 0];
    const Eigen::Vector2d outward = Eigen::Vector2d(b.y() - a.y(), a.x() - b.x()).normalized();
    const Eigen::Vector3d n = outward.x() * ground.east + outward.y() * ground.north;
    const Eigen::Vector3d on_plane = frame.global(a.x() * ground.east + a.y() * ground.north);
    const double limit = n.dot(on_plane - center) - error_bound;
    if (!(limit > 0)) return {};  // The polygon is so thin that all points are near the outline.
    result.planes[result.count++] = {n.x(), n.y(), n.z(), is_float ? static_cast<float>(limit) : limit};
  }
  return result;
}

Outline chunk_outline(UsableIsa isa, const PointView& chunk, const Supports& supports,
                      const HalfSpaces& inside, const LocalFrame& frame, const Ground& ground) {
  std::array<std::uint32_t, kBlockPoints> positions;
  Outline outline;
  for (std::size_t k = 0; k * kBlockPoints < chunk.count; ++k) {
    const PointView block = block_of(chunk, k);
    const std::size_t count = list_outside(isa, block, inside, positions.data());
    for (std::size_t i = 0; i < count; ++i) {
      const Coordinates p = load_point(block, positions[i]);
      if (!is_valid(p)) continue;
      require_same_points(within(supports, p));
      outline.push_back(ground.flat(frame.local(p)));
    }
  }
  outline.resize(to_convex_chain(outline.data(), outline.size()));
  return outline;
}

}  // namespace

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

Outline outline_from_above(const PointView& points, const Supports& supports, const LocalFrame& frame,
                           const Ground& ground, const FitExecution& execution) {
  const HalfSpaces inside =
      outline_half_spaces(points, support_or_all_points(points, supports, frame), frame, ground);
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
