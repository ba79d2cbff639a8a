// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>

#include "hull/hull_fit.h"
#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/small_ball.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/vector3.h"
#include "round/axis_search.h"

namespace pcl_bv::detail {
namespace {

struct Candidate {
  double low = 0, high = 0;  // the ends of the segment, along the axis
  double radius = 0;
  double volume() const { return radius * radius * ((high - low) + 4 * radius / 3); }  // divided by pi
};

// Returns the shortest capsule of this radius. The centre of each cap is as far inward as the points allow.
// `cap_length` is the length by which a cap extends beyond its centre, measured at the point's distance from
// the axis.
Candidate shortest(const Profile& profile, double squared_radius) {
  double low = profile.projections.front(), high = low;
  bool first = true;
  for (std::size_t i = 0; i < profile.projections.size(); ++i) {
    const double cap_length = std::sqrt(std::max(0.0, squared_radius - profile.squared[i]));
    low = first ? profile.projections[i] + cap_length : std::min(low, profile.projections[i] + cap_length);
    high = first ? profile.projections[i] - cap_length : std::max(high, profile.projections[i] - cap_length);
    first = false;
  }
  if (low > high) low = high = low + (high - low) / 2;
  return {low, high, std::sqrt(squared_radius)};
}

// Tries larger radii, because a wider capsule can be so much shorter that its volume is smaller.
Candidate widened(const Profile& profile) {
  Candidate best = shortest(profile, profile.squared_radius);
  constexpr int kHalvings = 18;  // steps down to 2e-6 of the radius
  double width = 1, step = 0.25;
  for (int halving = 0; halving < kHalvings; ++halving, step /= 2) {
    for (const double next : {width * (1 + step), std::max(1.0, width / (1 + step))}) {
      const Candidate candidate = shortest(profile, profile.squared_radius * (next * next));
      if (!(candidate.volume() < best.volume())) continue;
      best = candidate;
      width = next;
    }
  }
  return best;
}

// Returns the capsule with the segment from a to b that encloses all points. Let q = p - a, e = b - a and U =
// 2^-53. The error of the computed distance from the segment is less than 20 U (|q|_1 + |e|_1). This includes
// the errors of the foot, the differences and the lengths.
Capsule measured_capsule(const LocalHull& hull, const LocalFrame& frame, const Eigen::Vector3d& a,
                         const Eigen::Vector3d& b) {
  const Eigen::Vector3d e = (b - a) * frame.scale();
  const double length = norm3(e);
  const Eigen::Vector3d axis = length > 0 ? Eigen::Vector3d(e / length) : Eigen::Vector3d::Zero();
  double radius = 0;
  for (const HullPoint& candidate : hull.candidates) {
    const Eigen::Vector3d q = frame.relative_to(a, candidate.point);
    const double foot = std::clamp(dot3(q, axis), 0.0, length);
    radius = std::max(radius, norm3(q - foot * axis) + 32 * kUnitRoundoff * (taxicab3(q) + taxicab3(e)));
  }
  return {a, b, frame.length_up(radius)};
}

Capsule find_capsule(const LocalHull& hull, const LocalFrame& frame) {
  Profile profile;
  Eigen::Vector3d axis = hull.axes.col(0);
  if (hull.rank >= 2) {
    const std::vector<Eigen::Vector3d> searched = search_vertices(hull);
    axis = search_axis(hull, [&](const Eigen::Vector3d& tried) {
      profile.project(tried, searched);
      profile.measure_distances();
      return shortest(profile, profile.squared_radius).volume();
    });
  }
  const std::vector<Eigen::Vector3d> vertices = hull.local_vertices();
  profile.project(axis, vertices);
  profile.measure_distances();
  const Candidate best = widened(profile);
  const SmallBall ball = smallest_ball(vertices.data(), vertices.size());
  if (ball.squared_radius * std::sqrt(ball.squared_radius) * 4 / 3 <= best.volume()) {
    const Eigen::Vector3d center = frame.global(ball.center);
    return measured_capsule(hull, frame, center, center);
  }
  return measured_capsule(hull, frame, frame.global(profile.foot + best.low * axis),
                          frame.global(profile.foot + best.high * axis));
}

}  // namespace

EstimationResult fit_capsule(const PointView& points, Capsule& capsule, const FitExecution& execution) {
  capsule = Capsule();
  return fit_on_hull(points, execution, [&](const LocalHull& hull, const LocalFrame& frame, const Supports&) {
    capsule = find_capsule(hull, frame);
  });
}

}  // namespace pcl_bv::detail
