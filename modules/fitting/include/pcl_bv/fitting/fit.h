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
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/capsule.h"
#include "pcl_bv/volumes/cylinder.h"
#include "pcl_bv/volumes/ellipsoid.h"
#include "pcl_bv/volumes/hull.h"
#include "pcl_bv/volumes/kdop.h"
#include "pcl_bv/volumes/sphere.h"

namespace [[gnu::visibility("default")]] pcl_bv {

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

/// Why an ellipsoid is nearly the smallest: points p_i of the cloud with weights w_i > 0 whose sum is 1. With
/// S their weighted covariance, no ellipsoid around them has a volume below 4 pi / 3 sqrt(27 det S)
/// (Khachiyan 1996).
struct EllipsoidCertificate {
  std::vector<std::size_t> support;  ///< The cloud's numbers of the points.
  std::vector<double> weights;
  double lower_bound = 0;  ///< That volume, with room for its rounding; 0 for flat points.
  /// By how much of the bound the volume exceeds it; for flat points the area or length that they span.
  double excess = 0;
  int iterations = 0;
};

/// The axis-aligned box of the points: their exact minimum and maximum. Paper §2.
///
/// Empty input or no finite point: an empty box and `no_valid_points`. One point: a box of that point. O(n),
/// one pass; up to six for the rank of flat points (find_supports()). Throws std::invalid_argument for
/// Execution::supports of other points, and what the source of the points throws, if they have one.
EstimationResult fit_aabb(const PointView& points, Aabb& box, const Execution& execution = {});

/// The k-DOP of the points along the directions of `set` (not null): each slab is the true extreme, rounded
/// outward to the next double where it is none itself. Paper §2, Figure 2. Same rules as fit_aabb(),
/// and std::invalid_argument for a null set. A projection that is no double can leave the slab of a flat
/// cloud one step wide. O(n) for each direction; your own take about twice the time of the built-in ones, and
/// a pass more.
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
/// point or equal points: radius 0. Two passes over the points, three for `epos98`.
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

/// The convex hull of the points. Its vertices are exactly the extreme points of the cloud, those that are
/// not in the hull of others (of equal ones the first), its triangles their surface, and each plane's offset
/// is the exact greatest projection of all points on its normal, rounded up. Same rules as fit_aabb(). The
/// hull has the rank of the points (result.h); of one that is flat to 2^-36 the vertices are the corners of a
/// polygon, up to that, and the planes enclose all the same.
///
/// Akl and Toussaint 1978 drop the points inside the hull of the extremal ones, O(n); of the m others Barber,
/// Dobkin and Huhdanpaa 1996 find the hull, O(m log m) as a rule.
EstimationResult fit_hull(const PointView& points, Hull& hull, const Execution& execution = {});

/// A small cylinder around the points: of the axes that a search over the hemisphere and steps from the best
/// find good, the best; for that axis the smallest circle and the least height. No proof that no other axis
/// is better. Same rules as fit_hull(); points in a plane give a disc, on a line a segment. As fit_hull(),
/// and some thousand times O(vertices).
EstimationResult fit_cylinder(const PointView& points, Cylinder& cylinder, const Execution& execution = {});

/// A small capsule around the points, found as fit_cylinder() finds its axis; then each end is as far in as
/// the points leave it, and the radius wider than the smallest where that makes it smaller. Never greater
/// than the smallest sphere, but for rounding. Same rules.
EstimationResult fit_capsule(const PointView& points, Capsule& capsule, const Execution& execution = {});

/// The smallest ellipsoid around the points, to some 1e-6 of its volume: the certificate says how near and
/// why. Same rules as fit_hull(); radii along which the points are flat are 2^-30 of the greatest (all are 0
/// for one point). As fit_hull(), and some hundred to thousand times O(vertices).
///
/// Khachiyan 1996; Harman, Filova and Richtarik 2020.
EstimationResult fit_ellipsoid(const PointView& points, Ellipsoid& ellipsoid,
                               EllipsoidCertificate& certificate, const Execution& execution = {});
EstimationResult fit_ellipsoid(const PointView& points, Ellipsoid& ellipsoid,
                               const Execution& execution = {});

}  // namespace pcl_bv
