// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Points to volumes. Everything here keeps the promises of docs/numerics.md: each finite point is inside by
// exact real arithmetic; the same bits on every instruction set and thread count.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/fitting/result.h"
#include "pcl_bv/kernels/point_view.h"
#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/kdop.h"
#include "pcl_bv/volumes/sphere.h"

namespace pcl_bv {

/// How a bounding sphere is found, loosest first.
enum class SphereMethod : std::uint8_t {
  ritter,  ///< Ritter 1990: from the two ends, farthest apart, of an axis; grown.
  epos6,   ///< Larsson 2008: the smallest ball of the extremal points along 3 directions; grown.
  epos14,  ///< The same with 7 directions: the corners of the cube, too.
  epos26,  ///< With 13: its edges, too.
  epos98,  ///< With 49: (0,1,2), (1,1,2) and (1,2,2) in all places and signs, too.
  exact    ///< The smallest sphere there is: EPOS-26's ball, corrected by the farthest points until none is
           ///< outside.
};

/// How a first sphere comes to hold the points that it leaves outside (paper, section 5). Not for `exact`.
enum class SphereGrowth : std::uint8_t {
  /// Point after point in the order of the view, in one thread (the paper's Figure 3).
  sequential,
  /// The centre stays; the radius becomes the greatest distance, found in parallel. Simplest, and looser: a
  /// point outside by d adds d to the radius, where a step of growth adds d / 2.
  stationary,
  /// Points outside of the first sphere are collected in parallel, then it grows over them by ascending
  /// index.
  /// The same sphere, to the bit, as `sequential` where the view has no index list or an ascending one: a
  /// point inside the first sphere is inside all later ones.
  deferred
};

/// What fit_sphere() is asked for.
struct SphereOptions {
  // Not explicit: a method alone says enough.
  SphereOptions(SphereMethod m = SphereMethod::exact, SphereGrowth g = SphereGrowth::deferred)
      : method(m), growth(g) {}

  SphereMethod method;
  SphereGrowth growth;
};

/// Why a sphere cannot be smaller: up to four points p_i of the cloud and weights w_i >= 0 with sum 1. With
/// c = sum w_i p_i, every sphere around these points has a squared radius of at least sum w_i |p_i - c|^2.
struct SphereCertificate {
  int support_size = 0;                  ///< 1 to 4; 0 without a valid point.
  std::array<std::size_t, 4> support{};  ///< The cloud's numbers of the points.
  std::array<double, 4> weights{};
  double lower_bound = 0;  ///< No enclosing sphere has a smaller radius, by exact arithmetic on the above.
  int passes = 0;          ///< Scans for points outside, after the one for the extremal points.
};

/// The axis-aligned box of the points: their exact minimum and maximum. Paper §2.
///
/// Empty input or no finite point: an empty box and `no_valid_points`. One point: a box of that point. O(n),
/// one pass. Throws std::invalid_argument only for an unusable instruction set.
EstimationResult fit_aabb(const PointView& points, Aabb& box, const Execution& execution = {});

/// The k-DOP of the points along the directions of `set` (not null): each slab is the true extreme, rounded
/// outward to the next double where it is none itself. Paper §2, Figure 2. Same rules as fit_aabb(),
/// and std::invalid_argument for a null set. The rank is that of the points, even where a projection that is
/// no double leaves a flat slab one step wide. O(n) for each direction; your own take about twice the time of
/// the built-in ones.
EstimationResult fit_kdop(const PointView& points, const std::shared_ptr<const KdopSet>& set, Kdop& kdop,
                          const Execution& execution = {});

/// The extremal points of a k-DOP: per slab the index, in the cloud, of the point that touches it at its min
/// and at its max side; of several the smallest. Paper §3.
struct SlabPoints {
  std::vector<std::size_t> min;
  std::vector<std::size_t> max;
};

/// The same, and which points touch the slabs; `touching` is empty if there is no valid point.
EstimationResult fit_kdop(const PointView& points, const std::shared_ptr<const KdopSet>& set, Kdop& kdop,
                          SlabPoints& touching, const Execution& execution = {});

/// A sphere around the points, centre and radius in the points' unit. Paper §3. Same rules as fit_aabb(); one
/// point or equal points: radius 0. The rank is that along the 3 axes for `ritter` and `epos6`, 7 directions
/// for `epos14`, 13 for the others. Two passes over the points, three for `epos98`.
EstimationResult fit_sphere(const PointView& points, const SphereOptions& options, Sphere& sphere,
                            const Execution& execution = {});

/// The smallest sphere around the points, and the proof. Its radius exceeds certificate.lower_bound by at
/// most 1e-12 of itself, and what the rounding of the stored centre to double costs (half a unit in the last
/// place of its coordinates). Same rules as fit_aabb().
///
/// Larsson, Capannini and Kallberg 2016: the ball of few points, corrected by the farthest point outside in
/// each octant. Two passes over most clouds; more over the part near the surface. It always ends.
EstimationResult fit_smallest_sphere(const PointView& points, Sphere& sphere, SphereCertificate& certificate,
                                     const Execution& execution = {});

}  // namespace pcl_bv
