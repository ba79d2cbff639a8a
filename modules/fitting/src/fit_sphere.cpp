// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// EPOS (Larsson 2008): a ball of few extremal points, grown over the points that it leaves outside.

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "pcl_bv/fitting/extremes.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/small_ball.h"
#include "pcl_bv/kernels/chunks.h"
#include "pcl_bv/kernels/float_environment.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "schedule.h"

namespace pcl_bv {
namespace {

// Half of 2^-48, the bound on d2's relative error that numerics allows itself: it covers the root, too.
constexpr double kOutward = 1.0 + 0x1p-49;

Eigen::Vector3d vector(const Coordinates& p) {
  return {p.x, p.y, p.z};
}

// Distances in units of a power of two near the cloud's extent, so that no square over- or underflows.
class ScaledDistance {
 public:
  explicit ScaledDistance(double extent)
      : scale_(std::ldexp(1.0, -std::clamp(std::ilogb(extent), -1000, 1000))) {}

  // Separate products and sums: the same bits on every machine.
  double squared(const Eigen::Vector3d& p, const Eigen::Vector3d& center) const {
    const double x = (p.x() - center.x()) * scale_;
    const double y = (p.y() - center.y()) * scale_;
    const double z = (p.z() - center.z()) * scale_;
    return (x * x + y * y) + z * z;
  }

  Eigen::Vector3d scaled(const Eigen::Vector3d& p, const Eigen::Vector3d& origin) const {
    return (p - origin) * scale_;
  }
  Eigen::Vector3d unscaled(const Eigen::Vector3d& p, const Eigen::Vector3d& origin) const {
    return origin + p / scale_;
  }

  // A radius in the cloud's unit, not smaller; dividing by a power of two is inexact only among denormals.
  double unscaled_radius(double r) const {
    const double radius = r / scale_;
    return radius * scale_ < r ? std::nextafter(radius, std::numeric_limits<double>::infinity()) : radius;
  }

 private:
  double scale_;
};

std::vector<Eigen::Vector3d> extremal_points(const Extremes& extremes) {
  std::vector<const ExtremePoint*> ends;
  ends.reserve(2 * direction_count(extremes.set));
  for (std::size_t k = 0; k < direction_count(extremes.set); ++k) {
    ends.push_back(&extremes.low_point[k]);
    ends.push_back(&extremes.high_point[k]);
  }
  std::sort(ends.begin(), ends.end(), [](const auto* a, const auto* b) { return a->index < b->index; });
  ends.erase(std::unique(ends.begin(), ends.end(),
                         [](const auto* a, const auto* b) { return a->index == b->index; }),
             ends.end());
  std::vector<Eigen::Vector3d> points;
  points.reserve(ends.size());
  for (const ExtremePoint* end : ends)
    points.push_back(vector(end->point));
  return points;
}

struct Violator {
  std::size_t index;
  Eigen::Vector3d point;
};

// The points farther from the centre than the (scaled, squared) radius, by the index of the cloud.
std::vector<Violator> find_violators(const PointView& points, const Eigen::Vector3d& center,
                                     double squared_radius, const ScaledDistance& distance,
                                     const ParallelPolicy& parallel) {
  constexpr std::size_t chunk_points = 32 * kBlockPoints;
  const auto find = [&](std::size_t chunk) {
    const FloatEnvironment environment;
    std::vector<Violator> found;
    const std::size_t begin = chunk * chunk_points;
    const std::size_t end = std::min(begin + chunk_points, points.count);
    for (std::size_t i = begin; i < end; ++i) {
      const Coordinates p = load_point(points, i);
      if (distance.squared(vector(p), center) <= squared_radius || !is_valid(p)) continue;
      found.push_back({points.index(i), vector(p)});
    }
    return found;
  };
  const auto append = [](std::vector<Violator>& all, std::vector<Violator> found) {
    all.insert(all.end(), found.begin(), found.end());
  };
  const double serial_seconds = 2e-9 * static_cast<double>(points.count);
  std::vector<Violator> violators =
      reduce_chunks(worthwhile(parallel, serial_seconds), (points.count + chunk_points - 1) / chunk_points,
                    std::vector<Violator>{}, find, append);
  // An index list may name the points in any order, or twice.
  std::sort(violators.begin(), violators.end(),
            [](const auto& a, const auto& b) { return a.index < b.index; });
  return violators;
}

// Ritter's step: the ball through p and the far side of the old one; its radius, with what rounding may have
// moved.
void grow(const Eigen::Vector3d& p, const ScaledDistance& distance, Eigen::Vector3d& center, double& radius) {
  const double d = std::sqrt(distance.squared(p, center));
  if (d * kOutward <= radius) return;
  const double grown = (d + radius) / 2;
  const Eigen::Vector3d old = center;
  center = old + (d - grown) / d * (p - old);
  const double moved = std::sqrt(distance.squared(center, old)) * kOutward;
  const double reach = std::sqrt(distance.squared(p, center)) * kOutward;
  radius = std::max({grown, (moved + radius) * kOutward, reach});
}

Sphere epos_sphere(const PointView& points, const Extremes& extremes, const ParallelPolicy& parallel) {
  std::vector<Eigen::Vector3d> seeds = extremal_points(extremes);
  double extent = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    extent = std::max(extent, extremes.high[axis] - extremes.low[axis]);
  if (extent == 0) return {seeds.front(), 0.0};

  const ScaledDistance distance(extent);
  const Eigen::Vector3d origin = seeds.front();
  std::vector<Eigen::Vector3d> local;
  local.reserve(seeds.size());
  for (const Eigen::Vector3d& p : seeds)
    local.push_back(distance.scaled(p, origin));
  Eigen::Vector3d center = distance.unscaled(smallest_ball(local).center, origin);
  double squared_radius = 0;
  for (const Eigen::Vector3d& p : seeds)
    squared_radius = std::max(squared_radius, distance.squared(p, center));

  // Holds, exactly, whatever is no violator: d2 and the root are off by less than 2^-50.
  double radius = std::sqrt(squared_radius) * kOutward;
  for (const Violator& violator : find_violators(points, center, squared_radius, distance, parallel)) {
    grow(violator.point, distance, center, radius);
  }
  return {center, distance.unscaled_radius(radius)};
}

}  // namespace

EstimationResult fit_sphere(const PointView& points, SphereMethod method, Sphere& sphere,
                            const Execution& execution) {
  const FloatEnvironment environment;
  switch (method) {
    case SphereMethod::epos26:
      break;
  }
  const Extremes extremes = find_extremes(points, DirectionSet::dop26, ExtremeDetail::points, execution);
  sphere = extremes.used == 0 ? Sphere() : epos_sphere(points, extremes, execution.parallel);
  return result_of(extremes);
}

}  // namespace pcl_bv
