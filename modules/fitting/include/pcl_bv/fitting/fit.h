// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Functions that fit bounding volumes to points. All of them keep the guarantees of docs/numerics.md: each
// finite point is inside the volume by exact real arithmetic, and the result has the same bits for every
// instruction set and thread count. "The paper" is the first entry of docs/references.md.
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

/// How a bounding sphere is computed, from the loosest to the tightest. All methods but `exact` compute a
/// first sphere of a few points, then grow it until it encloses all points (SphereGrowth).
enum class SphereMethod : std::uint8_t {
  ritter,  ///< Ritter 1990: the ball of two points, the extremal points of one axis that are farthest apart.
  epos6,   ///< Larsson 2008: the smallest ball of the extremal points along 3 directions: a cube's faces.
  epos14,  ///< As epos6 with 7 directions: also the corners of the cube.
  epos26,  ///< As epos6 with 13 directions: also the edges of the cube.
  epos98,  ///< As epos6 with 49 directions: also (0,1,2), (1,1,2), (1,2,2), with all permutations and signs.
  exact    ///< The smallest sphere: the ball of EPOS-26's points, to which the farthest outside points are
           ///< added until no point is outside.
};

/// How a first sphere is enlarged until it encloses all points (the paper, §5). `exact` does not use it.
enum class SphereGrowth : std::uint8_t {
  /// One point after another in the order of the view, in one thread (the paper, Figure 3).
  sequential,
  /// The centre stays; the radius becomes the largest distance of a point, found in parallel. Simplest, but
  /// looser: a point outside by a distance d adds d to the radius, a step of the other two only d / 2.
  stationary,
  /// The points outside the first sphere are collected in parallel; then the sphere grows over them in
  /// ascending order of their indices. The sphere has the same bits as with `sequential` if the view has no
  /// index list or an ascending one, because a point inside the first sphere is inside all later ones.
  deferred
};

/// Options of fit_sphere().
struct SphereOptions {
  // Not explicit, so that a method can be passed alone.
  SphereOptions(SphereMethod m = SphereMethod::exact, SphereGrowth g = SphereGrowth::deferred)
      : method(m), growth(g) {}

  SphereMethod method;  ///< How the sphere is computed.
  SphereGrowth growth;  ///< How a first sphere is enlarged; `exact` ignores it.
};

/// Proof that a sphere cannot be smaller: up to four points p_i of the cloud and weights w_i >= 0 with sum 1.
/// With c = sum w_i p_i, every sphere around these points has a squared radius of at least
/// sum w_i |p_i - c|^2.
struct SphereCertificate {
  int support_size = 0;                  ///< Number of points p_i: 1 to 4; 0 without a valid point.
  std::array<std::size_t, 4> support{};  ///< Indices of the points p_i in the cloud.
  std::array<double, 4> weights{};       ///< The weights w_i.
  /// Lower bound of the radius of any enclosing sphere, proven by exact arithmetic on the points and weights.
  double lower_bound = 0;
  /// Number of passes that looked for points outside; the pass for the extremal points is not counted.
  int passes = 0;
};

/// Proof that an ellipsoid is nearly the smallest: points p_i of the cloud with weights w_i > 0 whose sum is
/// 1. With S their weighted covariance, no ellipsoid around them has a volume below 4 pi / 3 sqrt(27 det S)
/// (Khachiyan 1996).
struct EllipsoidCertificate {
  std::vector<std::size_t> support;  ///< Indices of the points p_i in the cloud.
  std::vector<double> weights;       ///< The weights w_i.
  double lower_bound = 0;            ///< That volume, less a margin for its rounding; 0 for flat points.
  /// Relative excess of the volume over the bound: volume / bound - 1. For points of rank 2 it compares areas
  /// in their plane, for points of rank 1 lengths.
  double excess = 0;
  int iterations = 0;  ///< Iterations of the solver.
};

/// Fits the axis-aligned box of the points: their exact minimum and maximum. The paper, §2.
///
/// Empty input, or no finite point: an empty box and `no_valid_points`. One point: a box of that point. O(n),
/// one pass; flat points take up to six passes, for their rank (find_supports()). Throws
/// std::invalid_argument if Execution::supports were found for other points. Exceptions of the points' source
/// (PointView::source) are passed on.
EstimationResult fit_aabb(const PointView& points, Aabb& box, const Execution& execution = {});

/// Fits the k-DOP of the points along the directions of `set` (not null). Each slab is the exact minimum and
/// maximum projection; a projection that is not a double is rounded outward to the next one. The paper, §2,
/// Figure 2.
///
/// Empty input and errors as for fit_aabb(); a null set throws std::invalid_argument, too. Where a projection
/// is not a double, the slab of a flat cloud can be one rounding step wide. O(n) for each direction. Sets of
/// your own directions take about twice the time of the built-in sets, and one pass more.
EstimationResult fit_kdop(const PointView& points, const std::shared_ptr<const KdopSet>& set, Kdop& kdop,
                          const Execution& execution = {});

/// The extremal points of a k-DOP: for each slab the index, in the cloud, of a point that touches its minimum
/// side and of a point that touches its maximum side. Of several such points the one with the smallest index.
/// The paper, §3.
struct SlabPoints {
  std::vector<std::size_t> min;  ///< For each slab the point on its minimum side.
  std::vector<std::size_t> max;  ///< For each slab the point on its maximum side.
};

/// As above; also returns the points that touch the slabs. `touching` is empty if there is no valid point.
EstimationResult fit_kdop(const PointView& points, const std::shared_ptr<const KdopSet>& set, Kdop& kdop,
                          SlabPoints& touching, const Execution& execution = {});

/// Fits a sphere around the points, centre and radius in the points' unit. The paper, §3. Empty input and
/// errors as for fit_aabb(). One point or equal points: radius 0. Two passes over the points, three for
/// `epos98`.
EstimationResult fit_sphere(const PointView& points, const SphereOptions& options, Sphere& sphere,
                            const Execution& execution = {});

/// Fits the smallest sphere around the points, with the proof. The radius exceeds certificate.lower_bound by
/// at most 1e-12 of itself, plus the rounding of the stored centre to double (half a unit in the last place
/// of its coordinates). Empty input and errors as for fit_aabb().
///
/// Larsson, Capannini, Källberg 2016: the smallest ball of a few points; the farthest outside point in each
/// octant is added to them until no point is outside. Most clouds take two passes; further passes mostly
/// inspect only the points near the surface. It always ends.
EstimationResult fit_smallest_sphere(const PointView& points, Sphere& sphere, SphereCertificate& certificate,
                                     const Execution& execution = {});

/// Computes the convex hull of the points. The vertices are exactly the extreme points of the cloud: those
/// that are not in the convex hull of the other points (of equal points the first). The triangles are the
/// surface. The offset of each plane is the exact maximum projection of all points on the plane's normal,
/// rounded up. Empty input and errors as for fit_aabb().
///
/// The hull has the rank of the points (result.h). If the points are flat to 2^-36, the vertices are the
/// corners of a polygon, to the same tolerance; the planes still enclose all points.
///
/// Akl, Toussaint 1978 drops the points inside the hull of the extremal points, in O(n). Barber, Dobkin,
/// Huhdanpaa 1996 finds the hull of the m remaining points, usually in O(m log m).
EstimationResult fit_hull(const PointView& points, Hull& hull, const Execution& execution = {});

/// Fits a small cylinder around the points. The axis is the best that a search finds: it tries directions
/// over the hemisphere and improves the best of them step by step. For this axis, the circle is the smallest
/// and the height the minimum. There is no proof that no other axis is better.
///
/// Empty input and errors as for fit_hull(). Points in a plane give a disc, points on a line a segment. Takes
/// the time of fit_hull(), plus about a thousand times O(vertices).
EstimationResult fit_cylinder(const PointView& points, Cylinder& cylinder, const Execution& execution = {});

/// Fits a small capsule around the points. The axis is found as for fit_cylinder(). Then each end is as far
/// inward as the points allow; the radius is larger than the smallest possible one where that makes the
/// volume smaller. Except for rounding, the volume is never larger than that of the smallest sphere. Empty
/// input, errors and time as for fit_cylinder().
EstimationResult fit_capsule(const PointView& points, Capsule& capsule, const Execution& execution = {});

/// Fits the smallest ellipsoid around the points, to about 1e-6 of its volume. The certificate proves how
/// near it is. Empty input and errors as for fit_hull(). Along directions in which the points are flat, the
/// radius is 2^-30 of the largest one; for one point all radii are 0. Takes the time of fit_hull(), plus
/// about a hundred to a thousand times O(vertices).
///
/// Khachiyan 1996; Harman, Filova and Richtarik 2020.
EstimationResult fit_ellipsoid(const PointView& points, Ellipsoid& ellipsoid,
                               EllipsoidCertificate& certificate, const Execution& execution = {});

/// As above, without the certificate.
EstimationResult fit_ellipsoid(const PointView& points, Ellipsoid& ellipsoid,
                               const Execution& execution = {});

}  // namespace pcl_bv
