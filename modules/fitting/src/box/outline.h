// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The convex outline of a cloud seen from above.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "local_frame.h"
#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/kernels/half_spaces.h"
#include "same_points.h"
#include "small_vector.h"

namespace pcl_bv::detail {

/// Returns up / |up|. Throws std::invalid_argument, which begins with the name of the fit, unless `up` is in
/// the range of ObbOptions::up.
Eigen::Vector3d unit_up(const char* fit, const Eigen::Vector3d& up);

/// The plane perpendicular to `up`, with the orthonormal axes `east` and `north`.
struct Ground {
  explicit Ground(const Eigen::Vector3d& unit_up);

  /// Returns the coordinates of a point seen from above.
  Eigen::Vector2d flat(const Eigen::Vector3d& p) const { return {east.dot(p), north.dot(p)}; }

  /// Returns orthonormal axes: the first is up, the second is along `side`.
  Eigen::Matrix3d axes_along(const Eigen::Vector2d& side) const;

  Eigen::Vector3d up, east, north;
};

/// Returns the vertical half-spaces through the edges of the polygon of the extremal points seen from above
/// (Akl, Toussaint 1978). In exact arithmetic, each point that list_outside() does not list is strictly
/// inside this polygon, with the coordinates ground.east . p and ground.north . p. `supports` must have the
/// set dop26 and SupportDetail::points. Without half-spaces, every point is listed.
HalfSpaces outline_half_spaces(const PointView& points, const Supports& supports, const LocalFrame& frame,
                               const Ground& ground);

/// Calls visit(p) for the valid points of a chunk that are not inside the half-spaces, in the order of the
/// chunk.
template <typename Visit>
void for_each_outside(UsableIsa isa, const PointView& chunk, const Supports& supports,
                      const HalfSpaces& inside, const Visit& visit) {
  std::array<std::uint32_t, kBlockPoints> positions;
  for (std::size_t k = 0; k * kBlockPoints < chunk.count; ++k) {
    const PointView block = block_of(chunk, k);
    const std::size_t count = list_outside(isa, block, inside, positions.data());
    for (std::size_t i = 0; i < count; ++i) {
      const Coordinates p = load_point(block, positions[i]);
      if (!is_valid(p)) continue;
      require_same_points(within(supports, p));
      visit(p);
    }
  }
}

/// Corners of a convex polygon, counter-clockwise. Up to 1024 corners are stored without an allocation. For a
/// small cluster, of which a sweep can have thousands, an allocation would take longer than computing the
/// outline.
using Outline = SmallVector<Eigen::Vector2d, 1024>;

/// Returns the convex outline of the points seen from above, in local coordinates. The outline has at least
/// one corner, and rounding errors. `supports` must have the set dop26 and SupportDetail::points. The bits
/// are the same for every execution.
Outline outline_from_above(const PointView& points, const Supports& supports, const LocalFrame& frame,
                           const Ground& ground, const FitExecution& execution);

}  // namespace pcl_bv::detail
