// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <numbers>

#include "box/symmetric_eigen.h"
#include "hull/hull_fit.h"
#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/vector3.h"
#include "round/smallest_ellipsoid.h"

namespace pcl_bv::detail {
namespace {

// Relative tolerance of kappa (smallest_ellipsoid.cpp). If the solver meets it, the volume exceeds its lower
// bound by at most a relative 2e-6.
constexpr double kTolerance = 1e-6;
constexpr int kMostIterations = 300;

// Radii are at least this fraction of the largest radius. An ellipsoid with a smaller radius is practically
// flat, and distances divided by such a radius would be meaningless.
constexpr double kThinRadius = 0x1p-30;

// Finds the smallest ellipsoid of the vertices in the first `rank` coordinates of LocalHull::spread(). All
// affine coordinates give the same smallest ellipsoid, but in local coordinates the solver's matrices would
// be inaccurate for points thinner than 1e-8.
WeightedEllipsoid solve(const LocalHull& hull) {
  std::vector<Eigen::Vector3d> points;
  for (const HullPoint& v : hull.vertices)
    points.push_back(hull.spread(v.local));
  return smallest_ellipsoid(points, hull.rank, kTolerance, kMostIterations);
}

struct Axes {
  Eigen::Matrix3d axes;
  Eigen::Vector3d radii;  // in local units
};

// Scales the radii such that all points are inside. q has a relative error of U = 2^-53, and the error of
// q . axis is 5 U |q|_1.
Axes scaled(const LocalHull& hull, const LocalFrame& frame, const Eigen::Vector3d& center, Axes body) {
  double greatest = 0;
  for (const HullPoint& candidate : hull.candidates) {
    const Eigen::Vector3d q = frame.relative_to(center, candidate.point);
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double along = std::abs(dot3(body.axes.col(k), q)) + 8 * kUnitRoundoff * taxicab3(q);
      const double ratio = along > 0 ? along / body.radii[k] : 0;
      sum += ratio * ratio;
    }
    greatest = std::max(greatest, sum);
  }
  body.radii *= std::sqrt(greatest) * (1 + 16 * kUnitRoundoff);
  return body;
}

// Fills in the certificate. `ratio` compares volumes for rank 3, areas for rank 2, and lengths for rank 1.
// The margin of the bound covers rounding errors. These errors move the points in spread() coordinates by
// 2^-48 divided by the smallest entry of hull.distances.
void certify(const LocalHull& hull, const LocalFrame& frame, const WeightedEllipsoid& weighted,
             const Axes& body, EllipsoidCertificate& certificate) {
  const SymmetricEigen spread = symmetric_eigen(weighted.covariance);
  double ratio = 1, bound = 4 * std::numbers::pi / 3;
  for (int k = 0; k < hull.rank; ++k) {
    const double radius = std::sqrt(hull.rank * std::max(spread.values[k], 0.0)) * hull.distances[k];
    ratio *= body.radii[k] / radius;
    bound *= frame.length_down(radius);
  }
  certificate.excess = std::max(0.0, ratio - 1);
  certificate.lower_bound = hull.rank == 3 ? bound * (1 - 0x1p-40 / std::min(1.0, hull.distances[2])) : 0;
  for (std::size_t i = 0; i < hull.vertices.size(); ++i) {
    if (weighted.weights[i] == 0) continue;
    certificate.support.push_back(hull.vertices[i].index);
    certificate.weights.push_back(weighted.weights[i]);
  }
}

}  // namespace

EstimationResult fit_ellipsoid(const PointView& points, Ellipsoid& ellipsoid,
                               EllipsoidCertificate& certificate, const FitExecution& execution) {
  ellipsoid = Ellipsoid();
  certificate = EllipsoidCertificate();
  return fit_on_hull(points, execution, [&](const LocalHull& hull, const LocalFrame& frame, const Supports&) {
    if (hull.rank == 0) {
      certificate.support = {hull.vertices[0].index};
      certificate.weights = {1};
      // If the extent is below about 1e-312, even distinct points have rank 0. A ball with a radius of twice
      // the extent contains these points.
      const Eigen::Vector3d radii = Eigen::Vector3d::Constant(2 * frame.extent());
      ellipsoid = Ellipsoid(vector(hull.vertices[0].point), Eigen::Matrix3d::Identity(), radii);
      return;
    }
    const WeightedEllipsoid weighted = solve(hull);
    const Eigen::Matrix3d unspread = hull.distances.asDiagonal();
    const SymmetricEigen spread = symmetric_eigen(unspread * weighted.covariance * unspread);
    Axes body;
    Eigen::Vector3d center = hull.candidates.front().local;
    for (int k = 0; k < 3; ++k) {
      body.axes.col(k) = (hull.axes.col(0) * spread.vectors(0, k) + hull.axes.col(1) * spread.vectors(1, k)) +
                         hull.axes.col(2) * spread.vectors(2, k);
      body.radii[k] = std::sqrt(hull.rank * std::max(spread.values[k], 0.0));
      center += weighted.center[k] * hull.distances[k] * hull.axes.col(k);
    }
    body.radii = body.radii.cwiseMax(kThinRadius * body.radii[0]);
    center = frame.global(center);
    body = scaled(hull, frame, center, body);
    certificate.iterations = weighted.iterations;
    certify(hull, frame, weighted, body, certificate);
    const Eigen::Vector3d radii(frame.length_up(body.radii[0]), frame.length_up(body.radii[1]),
                                frame.length_up(body.radii[2]));
    ellipsoid = Ellipsoid(center, body.axes, radii);
  });
}

}  // namespace pcl_bv::detail
