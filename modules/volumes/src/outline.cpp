// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "bounds.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/volumes/planar_hull.h"

namespace pcl_bv::detail {
namespace {

using Corners = std::vector<Eigen::Vector2d>;

Corners hull_of(const Corners& points) {
  Corners corners;
  for (const std::size_t i : planar_hull(points))
    corners.emplace_back(points[i].array() + 0.0);
  return corners;
}

// Returns the outward unit normal of the edge from a to b.
Eigen::Vector2d outward(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return Eigen::Vector2d(b.y() - a.y(), a.x() - b.x()).stableNormalized();
}

// Appends the intersections of the polygon's edges after each edge has moved outward by `distance`. Skips a
// corner whose interior angle is so small (below 58 degrees) that it would move by more than twice the
// distance.
void add_moved_corners(const Corners& polygon, double distance, Corners& points) {
  const std::size_t count = polygon.size();
  if (count < 3) return;
  Eigen::Vector2d before = outward(polygon[count - 1], polygon[0]);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d after = outward(polygon[i], polygon[i + 1 < count ? i + 1 : 0]);
    const double cosine = before.x() * after.x() + before.y() * after.y();
    if (cosine > -0.53) points.emplace_back(polygon[i] + distance / (1 + cosine) * (before + after));
    before = after;
  }
}

// Coordinates of four corners of a regular polygon with 16 sides around the unit circle, rounded up: cos(k pi
// / 8) / cos(pi / 16) for k = 0, 1, 2, 3. Literals, because libraries round the cosine differently.
constexpr std::array<double, 4> kCircumscribed = {1.019591158208320, 0.941979402598144, 0.720959822006949,
                                                  0.390180644032258};

}  // namespace

std::vector<Eigen::Vector2d> outline_around(const std::vector<PlaneBox>& boxes) {
  Corners points;
  double widest = 0, farthest = 0;
  for (const auto& [low, high] : boxes) {
    points.push_back(low);
    widest = std::max(widest, (high - low).maxCoeff());
    farthest = std::max({farthest, low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff()});
  }
  Corners outer = hull_of(points);
  if (widest == 0) return outer;
  // The diagonal of a box is at most sqrt(2) times `widest`. The second term is sqrt(2) times the rounding of
  // the coordinates of a moved corner.
  const double distance = 1.415 * widest + 0x1.7p-53 * farthest;
  Corners all;
  add_moved_corners(outer, distance, all);
  for (const auto& [low, high] : boxes) {
    for (const Eigen::Vector2d& corner :
         {low, Eigen::Vector2d(high.x(), low.y()), high, Eigen::Vector2d(low.x(), high.y())})
      all.push_back(corner);
  }
  return hull_of(all);
}

Prism convex_prism(const Prism& prism) {
  if (prism.is_convex()) return prism;
  return PrismAccess::make(prism.axes(), hull_of(prism.outline()), prism.low(), prism.high());
}

Prism inflated_prism(const Prism& prism, double padding) {
  const FloatEnvironment environment;
  if (prism.empty() || padding == 0) return prism;
  // A step of length 1 changes the coordinates (u, v) by at most this factor.
  const double reach = multiply_up(padding, matrix_norm_up(prism.axes().transpose()));
  std::vector<PlaneBox> boxes;
  for (const Eigen::Vector2d& corner : prism.outline()) {
    for (std::size_t k = 0; k < 16; ++k) {
      const std::size_t in_quarter = k % 4;
      double x = multiply_up(reach, kCircumscribed[in_quarter]);
      double y = in_quarter == 0 ? 0.0 : multiply_up(reach, kCircumscribed[4 - in_quarter]);
      for (std::size_t quarter = 0; quarter < k / 4; ++quarter)
        std::tie(x, y) = std::pair(-y, x);
      // Both coordinates are rounded away from the corner.
      const Eigen::Vector2d p(x < 0 ? -add_up(-corner.x(), -x) : add_up(corner.x(), x),
                              y < 0 ? -add_up(-corner.y(), -y) : add_up(corner.y(), y));
      boxes.push_back({p, p});
    }
  }
  return PrismAccess::make(prism.axes(), outline_around(boxes), -add_up(-prism.low(), reach),
                           add_up(prism.high(), reach));
}

}  // namespace pcl_bv::detail
