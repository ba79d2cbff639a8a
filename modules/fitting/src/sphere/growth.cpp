// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Applies Ritter's step to one point after another (Ritter 1990, Larsson 2008), in the orders of the paper,
// §5.

#include "sphere/growth.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl_bv::detail {
namespace {

// A sphere that only grows. In exact arithmetic, the sphere after each step contains the sphere before the
// step. Therefore points that are inside remain inside.
class GrowingSphere {
 public:
  GrowingSphere(const LocalFrame& frame, const Eigen::Vector3d& center, double squared_radius)
      : frame_(frame), center_(center), radius_(std::sqrt(squared_radius) * kOutward) {}

  DistanceCenter center() const { return frame_.center(center_); }

  // Points with a smaller squared distance do not make the sphere grow.
  double squared_radius() const { return radius_ * radius_ * (1 - 0x1p-50); }

  // Grows to the sphere through p and the far side of the old sphere, with a margin for rounding. A point
  // that is inside in exact arithmetic never changes the sphere, so callers may pass or omit such points.
  void grow(const Coordinates& p) {
    const double d = std::sqrt(squared_distance(p, center()));
    if (!(d > radius_ * kInside)) return;
    const double grown = (d + radius_) / 2;
    const Eigen::Vector3d old = center_;
    center_ = old + (d - grown) / d * (vector(p) - old);
    const double moved = std::sqrt(squared_distance({old.x(), old.y(), old.z()}, center())) * kOutward;
    const double distance = std::sqrt(squared_distance(p, center())) * kOutward;
    radius_ = std::max({grown, (moved + radius_) * kOutward, distance});
  }

  // Returns the sphere with a margin for the points that grow() treats as inside because of kInside.
  Sphere finish() const { return {center_, frame_.radius(radius_ * kOutward)}; }

 private:
  static constexpr double kInside = 1 + 0x1p-50;

  const LocalFrame& frame_;
  Eigen::Vector3d center_;
  double radius_;  // in the unit of the kernels
};

void grow_over_block(const DistanceScan& scan, std::size_t block, GrowingSphere& sphere) {
  scan.visit_block(block, sphere.center(), sphere.squared_radius(),
                   [&](std::size_t, const Coordinates& p) { sphere.grow(p); });
}

void grow_in_order(const DistanceScan& scan, GrowingSphere& sphere) {
  for (std::size_t block = 0; block < block_count(scan.points().count); ++block)
    grow_over_block(scan, block, sphere);
}

// Calls visit(block), in ascending order, for the blocks with points outside the sphere. The blocks are found
// in parallel before the first call, so visit() may grow the sphere.
template <typename Visit>
void for_each_block_outside(const DistanceScan& scan, const GrowingSphere& sphere, const Visit& visit) {
  const double limit = sphere.squared_radius();
  BlockMaxima maxima;
  scan.block_maxima(sphere.center(), limit, maxima);
  for (std::size_t block = 0; block < maxima.size(); ++block) {
    if (maxima[block] >= limit) visit(block);
  }
}

// Grows the sphere over the points outside it, in ascending order of their indices. The view's index list may
// have any order.
void grow_by_index(const DistanceScan& scan, GrowingSphere& sphere) {
  const PointView& points = scan.points();
  std::vector<std::size_t> outside;
  for_each_block_outside(scan, sphere, [&](std::size_t block) {
    scan.visit_block(block, sphere.center(), sphere.squared_radius(),
                     [&](std::size_t i, const Coordinates&) { outside.push_back(block * kBlockPoints + i); });
  });
  std::sort(outside.begin(), outside.end(),
            [&](std::size_t a, std::size_t b) { return points.index(a) < points.index(b); });
  for (const std::size_t i : outside)
    sphere.grow(load_point(points, i));
}

bool ascending(const PointView& points) {
  return points.indices == nullptr || std::is_sorted(points.indices, points.indices + points.count);
}

}  // namespace

Sphere grow_sphere(const DistanceScan& scan, const LocalFrame& frame, const Eigen::Vector3d& center,
                   double squared_radius, SphereGrowth growth) {
  if (growth == SphereGrowth::stationary) {
    const double greatest = scan.greatest(frame.center(center), squared_radius);
    return {center, frame.radius(std::sqrt(greatest) * kOutward)};
  }
  GrowingSphere sphere(frame, center, squared_radius);
  if (growth == SphereGrowth::deferred && !ascending(scan.points())) {
    grow_by_index(scan, sphere);
  } else if (scan.has_device() || (growth == SphereGrowth::deferred && !scan.serial())) {
    // Each block is compared with the sphere that has grown over the blocks before. The comparison skips only
    // points that would not change the sphere.
    for_each_block_outside(scan, sphere, [&](std::size_t block) { grow_over_block(scan, block, sphere); });
  } else {
    grow_in_order(scan, sphere);  // gives the bits of the deferred variants, and is faster in one thread
  }
  return sphere.finish();
}

}  // namespace pcl_bv::detail
