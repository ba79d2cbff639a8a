// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The orthant scan (Larsson, Capannini, Källberg 2016) computes the exact ball of a few points, scans all
// points, and adds the farthest outside point in each octant to the few points. It repeats this until no
// point is outside. First it does so with a sample of the points: of a ball around s of n points, about 4 n /
// s points are outside if the sample is random (Clarkson 1995). Blocks of points are not, but one pass over
// all points is usually enough.

#include "pcl_bv/fitting/smallest_sphere.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/float_environment.h"
#include "sphere/distance_scan.h"
#include "sphere/sphere_seed.h"

namespace pcl_bv::detail {
namespace {

// A point is outside only if its squared distance exceeds the largest squared distance of the candidates by
// this factor. Half of the margin is for the rounding of distances, the other half for the rounding of the
// ball.
constexpr double kNotOutside = 1 + 0x1p-48;

// Passes over fewer points take less time than a sample saves.
constexpr std::size_t kMinSampledPoints = 32 * kBlockPoints;

// Fills in the certificate. The lower bound has a margin for the rounding of the weights, of the bound itself
// and of the local coordinates.
void certify(const SmallBall& ball, const SeedPoints& candidates, const LocalFrame& frame,
             SphereCertificate& certificate) {
  certificate.support_size = ball.support_size;
  certificate.weights = ball.weights;
  for (std::size_t i = 0; i < static_cast<std::size_t>(ball.support_size); ++i)
    certificate.support[i] = candidates[ball.support[i]].index;
  certificate.lower_bound =
      frame.length_down(std::sqrt(std::max(0.0, ball.squared_lower_bound)) * (1 - 0x1p-48));
}

// Adds the points in `found` to the candidates. Returns false if all of them were candidates already.
bool add_candidates(const OctantPoints& found, SeedPoints& candidates) {
  bool added = false;
  for (const FarPoint& far : found) {
    if (far.squared_distance >= 0 && candidates.add(far.index, far.point)) added = true;
  }
  return added;
}

bool outside_everywhere(const OctantPoints& found) {
  return std::all_of(found.begin(), found.end(), [](const FarPoint& p) { return p.squared_distance >= 0; });
}

// Returns the smallest ball of the candidates, with bits that depend only on its support. Near-degenerate
// supports can lose a point when they are solved alone, so that another candidate is outside; then the ball
// stays as it was found.
SmallBall ball_of(const SeedPoints& candidates, const LocalFrame& frame, const SmallBall& start) {
  const SmallBall found = candidates.smallest_ball(frame, &start);
  const SmallBall alone = candidates.ball_of_support(frame, found);
  const auto greatest_distance = [&](const SmallBall& ball) {
    return candidates.greatest_distance(frame.center(frame.global(ball.center)));
  };
  return greatest_distance(alone) <= greatest_distance(found) * kNotOutside ? alone : found;
}

Sphere solve(const FarthestQuery& farthest, const LocalFrame& frame, SeedPoints candidates,
             std::size_t one_of, SphereCertificate& certificate) {
  Eigen::Vector3d best_center = Eigen::Vector3d::Zero();
  double best_distance = -1;  // squared distance of the farthest point
  SmallBall ball;
  for (;;) {
    ball = ball_of(candidates, frame, ball);
    certify(ball, candidates, frame, certificate);
    const Eigen::Vector3d center = frame.global(ball.center);
    const double limit = candidates.greatest_distance(frame.center(center)) * kNotOutside;
    OctantPoints found;
    const bool outside = farthest({frame.center(center), next_up(limit), one_of}, found);
    ++certificate.passes;
    // Each pass adds a point or is the last one of the sample or of all points, so the loop ends.
    const bool added = outside && add_candidates(found, candidates);
    if (one_of > 1) {
      // If points are outside in every octant, another pass over the sample is worth its time.
      if (!added || !outside_everywhere(found)) one_of = 1;
      continue;
    }
    double distance = limit;
    for (const FarPoint& far : found)
      distance = std::max(distance, far.squared_distance);
    if (best_distance < 0 || distance < best_distance) {
      best_distance = distance;
      best_center = center;
    }
    if (!added) break;
  }
  return {best_center, frame.radius(std::sqrt(best_distance) * kOutward)};
}

}  // namespace

void update_farthest(const FarPoint& other, FarPoint& best) {
  const bool tie = other.squared_distance == best.squared_distance;
  if (tie ? other.index < best.index : other.squared_distance > best.squared_distance) best = other;
}

void update_farthest(const OctantPoints& other, OctantPoints& best) {
  for (std::size_t o = 0; o < best.size(); ++o)
    update_farthest(other[o], best[o]);
}

std::size_t blocks_per_sampled(std::size_t points) {
  // The time for the sample and for the points outside its ball is smallest if the sample grows as the root
  // of the number of points.
  std::size_t one_of = 1;
  while (points >= kMinSampledPoints && 4 * one_of * one_of <= points / 128)
    one_of *= 2;
  return one_of;
}

bool in_sample(std::size_t block, std::size_t one_of) {
  // The fractional parts of the multiples of the golden ratio are spread evenly, also those of every second
  // or every hundredth block, for example at the same place in each row of an organised cloud.
  return std::uint64_t{block} * 0x9E3779B97F4A7C15U <= ~std::uint64_t{0} / one_of;
}

FarthestFinder::FarthestFinder(const PointView& points, const Execution& execution) {
  if (points.indices != nullptr) throw std::invalid_argument("FarthestFinder: the view has an index list");
  scan_ = std::make_unique<DistanceScan>(points, execution);
}

FarthestFinder::~FarthestFinder() = default;
FarthestFinder::FarthestFinder(FarthestFinder&&) noexcept = default;

bool FarthestFinder::operator()(const FarQuery& query, OctantPoints& found) {
  const FloatEnvironment environment;
  return scan_->farthest(query, found);
}

Sphere smallest_sphere(const Supports& supports, const FarthestQuery& farthest,
                       SphereCertificate& certificate) {
  certificate = SphereCertificate();
  if (supports.used == 0) return {};
  if (supports.set != DirectionSet::dop26 || supports.detail != SupportDetail::points)
    throw std::invalid_argument("smallest_sphere: supports must be along dop26, with points");
  const LocalFrame frame(supports);
  if (frame.extent() > 0)
    return solve(farthest, frame, SeedPoints(supports), blocks_per_sampled(supports.used), certificate);
  certificate.support_size = 1;
  certificate.support[0] = supports.along[0].low_point.index;
  certificate.weights[0] = 1;
  return {vector(supports.along[0].low_point.point), 0.0};
}

}  // namespace pcl_bv::detail
