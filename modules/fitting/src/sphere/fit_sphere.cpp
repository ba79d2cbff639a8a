// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <vector>

#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/smallest_sphere.h"
#include "pcl_bv/fitting/supports.h"
#include "sphere/distance_scan.h"
#include "sphere/growth.h"
#include "sphere/sphere_seed.h"
#include "spread_directions.h"
#include "support/support_search.h"

namespace pcl_bv::detail {
namespace {

DirectionSet seed_directions(SphereMethod method) {
  switch (method) {
    case SphereMethod::ritter:
    case SphereMethod::epos6:
      return DirectionSet::dop6;
    case SphereMethod::epos14:
      return DirectionSet::dop14;
    default:
      return DirectionSet::dop26;
  }
}

struct FirstBall {
  Eigen::Vector3d center;
  double squared_radius;  // in the unit of the kernels, squared
};

// Each axis has two extremal points. Takes the axis whose extremal points are farthest apart, and returns the
// ball with the segment between these two points as a diameter.
FirstBall ritter_ball(const Supports& supports, const LocalFrame& frame) {
  FirstBall ball{Eigen::Vector3d::Zero(), -1};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Coordinates& low = supports.along[axis].low_point.point;
    const Coordinates& high = supports.along[axis].high_point.point;
    const Eigen::Vector3d center = frame.global((frame.local(low) + frame.local(high)) / 2);
    const DistanceCenter from = frame.center(center);
    const double squared = std::max(squared_distance(low, from), squared_distance(high, from));
    if (squared > ball.squared_radius) ball = {center, squared};
  }
  return ball;
}

// Returns the directions of EPOS-98 that are not directions of the cube. Of two opposite directions it
// returns one.
std::vector<Direction> epos98_directions() {
  std::vector<Direction> directions = spread_directions();
  const auto of_cube = [](const Direction& d) {
    return std::none_of(d.begin(), d.end(), [](double c) { return std::abs(c) == 2; });
  };
  directions.erase(std::remove_if(directions.begin(), directions.end(), of_cube), directions.end());
  return directions;
}

// Returns the first ball of EPOS, which is the smallest ball of the support points. If the cloud has at most
// as many points as there are support points, returns the smallest ball of all points (Larsson 2008).
FirstBall epos_ball(const PointView& points, SphereMethod method, const Supports& supports,
                    const LocalFrame& frame, const FitExecution& execution) {
  const std::size_t ends = method == SphereMethod::epos98 ? 98 : 2 * direction_count(supports.set);
  const bool few = points.count <= ends;
  SeedPoints seeds = few ? SeedPoints(points, supports) : SeedPoints(supports);
  if (method == SphereMethod::epos98 && !few) {
    static const std::vector<Direction> directions = epos98_directions();
    for (const Support& along : find_supports(points, directions, execution).along) {
      seeds.add(along.low_point.index, along.low_point.point);
      seeds.add(along.high_point.index, along.high_point.point);
    }
  }
  const Eigen::Vector3d center = frame.global(seeds.smallest_ball(frame).center);
  return {center, seeds.greatest_distance(frame.center(center))};
}

Sphere grown_sphere(const PointView& points, const SphereOptions& options, const Supports& supports,
                    const LocalFrame& frame, const FitExecution& execution) {
  const FirstBall ball = options.method == SphereMethod::ritter
                             ? ritter_ball(supports, frame)
                             : epos_ball(points, options.method, supports, frame, execution);
  const DistanceScan scan(points, execution);
  return grow_sphere(scan, frame, ball.center, ball.squared_radius, options.growth);
}

}  // namespace

EstimationResult fit_sphere(const PointView& points, const SphereOptions& options, Sphere& sphere,
                            const FitExecution& execution) {
  if (options.method == SphereMethod::exact) {
    SphereCertificate certificate;
    return fit_smallest_sphere(points, sphere, certificate, execution);
  }
  require_all_points(execution, "a sphere that grows");
  const Supports supports =
      find_supports(points, seed_directions(options.method), SupportDetail::points, execution);
  sphere = Sphere();
  if (supports.used > 0) {
    const LocalFrame frame(supports);
    sphere = frame.extent() > 0 ? grown_sphere(points, options, supports, frame, execution)
                                : Sphere(vector(supports.along[0].low_point.point), 0.0);
  }
  return result_of(supports);
}

EstimationResult fit_smallest_sphere(const PointView& points, Sphere& sphere, SphereCertificate& certificate,
                                     const FitExecution& execution) {
  const Supports supports = find_supports(points, DirectionSet::dop26, SupportDetail::points, execution);
  DistanceScan scan(points, execution);
  const auto farthest = [&scan](const FarQuery& query, OctantPoints& found) {
    return scan.farthest(query, found);
  };
  sphere = smallest_sphere(supports, std::cref(farthest), certificate);
  return result_of(supports);
}

}  // namespace pcl_bv::detail
