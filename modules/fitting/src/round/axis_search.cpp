// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// search_axis() is a compass search in the tangent plane of the sphere of directions.

#include "round/axis_search.h"

#include <algorithm>
#include <cstdlib>

#include "orthogonal_basis.h"
#include "pcl_bv/fitting/small_ball.h"
#include "pcl_bv/numeric/vector3.h"
#include "spread_directions.h"

namespace pcl_bv::detail {
namespace {

struct Rated {
  double size;
  Eigen::Vector3d axis;
};

std::vector<Eigen::Vector3d> hemisphere() {
  std::vector<Eigen::Vector3d> axes;
  for (const Direction& d : spread_directions())
    axes.push_back(unit3(Eigen::Vector3d(d[0], d[1], d[2])));
  return axes;
}

// Moves to the best of eight neighbours if it is better than `best`. Otherwise halves the step and rotates
// the pattern of the neighbours by the angle with the cosine 3/5 and the sine 4/5. Without the rotation, a
// ridge along the pattern could stop the search.
void improve(Rated& best, double step, double last_step,
             const std::function<double(const Eigen::Vector3d&)>& size) {
  constexpr int kMostMoves = 400;
  double c = 1, s = 0;
  for (int moves = 0; step > last_step && moves < kMostMoves;) {
    const PlaneBasis plane(best.axis);
    Rated found = best;
    for (int k = 0; k < 8; ++k) {
      static constexpr double x[] = {1, -1, 0, 0, 0.7, -0.7, 0.7, -0.7},
                              y[] = {0, 0, 1, -1, 0.7, -0.7, -0.7, 0.7};
      const double right = step * (c * x[k] - s * y[k]), up = step * (s * x[k] + c * y[k]);
      const Eigen::Vector3d axis = unit3(best.axis + (right * plane.u + up * plane.v));
      const double rated = size(axis);
      if (rated < found.size) found = {rated, axis};
    }
    if (found.size < best.size) {
      best = found;
      ++moves;
    } else {
      step /= 2;
      const double turned = 0.6 * c - 0.8 * s;
      s = 0.8 * c + 0.6 * s;
      c = turned;
    }
  }
}

}  // namespace

void Profile::project(const Eigen::Vector3d& axis, const std::vector<Eigen::Vector3d>& points) {
  const PlaneBasis plane(axis);
  flat_.clear();
  projections.clear();
  low = high = dot3(axis, points.front());
  for (const Eigen::Vector3d& p : points) {
    flat_.emplace_back(dot3(plane.u, p), dot3(plane.v, p), 0.0);
    projections.push_back(dot3(axis, p));
    low = std::min(low, projections.back());
    high = std::max(high, projections.back());
  }
  const SmallBall circle = smallest_ball(flat_.data(), flat_.size());
  middle_ = circle.center;
  foot = circle.center.x() * plane.u + circle.center.y() * plane.v;
  squared_radius = circle.squared_radius;
}

void Profile::measure_distances() {
  squared.clear();
  for (const Eigen::Vector3d& f : flat_) {
    const double x = f.x() - middle_.x(), y = f.y() - middle_.y();
    squared.push_back(x * x + y * y);
  }
}

std::vector<Eigen::Vector3d> search_vertices(const LocalHull& hull) {
  constexpr std::size_t kMany = 1000;
  const std::vector<Eigen::Vector3d> all = hull.local_vertices();
  return all.size() > kMany ? support_points_along(hemisphere(), all) : all;
}

Eigen::Vector3d search_axis(const LocalHull& hull,
                            const std::function<double(const Eigen::Vector3d&)>& size) {
  constexpr std::size_t kStarts = 4;
  const std::vector<Eigen::Vector3d> spread = hemisphere();
  std::vector<Rated> rated;
  rated.reserve(3 + spread.size());
  for (int k = 0; k < 3; ++k)
    rated.push_back({size(hull.axes.col(k)), hull.axes.col(k)});
  for (const Eigen::Vector3d& axis : spread)
    rated.push_back({size(axis), axis});
  std::stable_sort(rated.begin(), rated.end(),
                   [](const Rated& a, const Rated& b) { return a.size < b.size; });
  rated.resize(kStarts);
  for (Rated& start : rated)
    improve(start, 0x1p-3, 0x1p-7, size);
  Rated best = *std::min_element(rated.begin(), rated.end(),
                                 [](const Rated& a, const Rated& b) { return a.size < b.size; });
  improve(best, 0x1p-7, 0x1p-27, size);
  return best.axis;
}

}  // namespace pcl_bv::detail
