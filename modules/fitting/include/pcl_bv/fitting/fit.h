// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Functions that fit bounding volumes to points. All of them give the guarantees of docs/numerics.md. Each
// valid point is inside the volume by exact real arithmetic, and the result has the same bits for every
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
  ritter,  ///< Ritter 1990. Each axis has two extremal points. The ball of the pair that is farthest apart.
  epos6,   ///< Larsson 2008. The smallest ball of the extremal points along the 3 face normals of a cube.
  epos14,  ///< As epos6, with 7 directions: also those through the corners of the cube.
  epos26,  ///< As epos6, with 13 directions: also those through the edges of the cube.
  epos98,  ///< As epos6, with 49 directions: also (0,1,2), (1,1,2), (1,2,2), with all permutations and signs.
  exact    ///< The smallest sphere. Begins with the ball of the points of epos26. The farthest outside points
           ///< are added to these points until no point is outside.
};

/// How a first sphere is enlarged until it encloses all points (the paper, §5). `exact` does not use it.
enum class SphereGrowth : std::uint8_t {
  /// One point after another in the order of the view, in one thread (the paper, Figure 3).
  sequential,
  /// The centre does not move. The radius becomes the largest distance of a point from it, which is found in
  /// parallel. This growth is the simplest but looser, because a point outside by a distance d adds d to the
  /// radius. With the other two growths such a point adds only d / 2.
  stationary,
  /// The points outside the first sphere are listed in parallel. Then the sphere grows over them in ascending
  /// order of their indices. If the view has no index list or an ascending one, the sphere has the same bits
  /// as with `sequential`, because a point inside the first sphere is inside all later spheres.
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
  int support_size = 0;                  ///< Number of points p_i, 1 to 4, or 0 without a valid point.
  std::array<std::size_t, 4> support{};  ///< Indices of the points p_i in the cloud.
  std::array<double, 4> weights{};       ///< The weights w_i.
  /// Lower bound of the radius of any enclosing sphere, proven by exact arithmetic on the points and weights.
  double lower_bound = 0;
  /// Number of passes that searched for points outside. The pass for the extremal points is not counted.
  int passes = 0;
};

/// Proof that an ellipsoid is nearly the smallest: points p_i of the cloud with weights w_i > 0 whose sum is
/// 1. With S their weighted covariance, no ellipsoid around them has a volume below 4 pi / 3 sqrt(27 det S)
/// (Khachiyan 1996).
struct EllipsoidCertificate {
  std::vector<std::size_t> support;  ///< Indices of the points p_i in the cloud.
  std::vector<double> weights;       ///< The weights w_i.
  /// Lower bound of the volume: 4 pi / 3 sqrt(27 det S) less a margin for rounding. 0 for flat points.
  double lower_bound = 0;
  /// Relative excess of the volume over its lower bound: volume / bound - 1. For points of rank 2 it compares
  /// areas in the plane of the points, for points of rank 1 it compares lengths.
  double excess = 0;
  int iterations = 0;  ///< Iterations of the solver.
};

/// Fits the axis-aligned box of the points: their exact minimum and maximum. The paper, §2.
///
/// If there is no valid point, the box is empty and the status is `no_valid_points`. One point gives a box of
/// that point only. O(n) in one pass. Flat points take up to six passes, because their rank needs more passes
/// (find_supports()). Throws std::invalid_argument if Execution::supports were found for other points.
/// Exceptions of the points' source (PointView::source) are passed on.
EstimationResult fit_aabb(const PointView& points, Aabb& box, const Execution& execution = {});

/// Fits the k-DOP of the points along the directions of `set` (not null). Each slab is the exact minimum and
/// maximum projection. A projection that no double represents is rounded outward to the next double. The
/// paper, §2, Figure 2.
///
/// Empty input and errors are as for fit_aabb(). A null set throws std::invalid_argument, too. Where a
/// projection is rounded, the slab of a flat cloud can be one rounding step wide. O(n) for each direction.
/// Sets of user-defined directions take about twice the time of the built-in sets, and one more pass.
EstimationResult fit_kdop(const PointView& points, const std::shared_ptr<const KdopSet>& set, Kdop& kdop,
                          const Execution& execution = {});

/// The extremal points of a k-DOP, as indices in the cloud. If several points touch a side of a slab, the
/// point with the smallest index is stored. The paper, §3.
struct SlabPoints {
  std::vector<std::size_t> min;  ///< For each slab the index of a point on its minimum side.
  std::vector<std::size_t> max;  ///< For each slab the index of a point on its maximum side.
};

/// As fit_kdop() above. Also returns the points that touch the slabs. `touching` is empty if there is no
/// valid point.
EstimationResult fit_kdop(const PointView& points, const std::shared_ptr<const KdopSet>& set, Kdop& kdop,
                          SlabPoints& touching, const Execution& execution = {});

/// Fits a sphere around the points. Centre and radius are in the points' unit. The paper, §3. Empty input and
/// errors are as for fit_aabb(). One point or equal points give radius 0. Takes two passes over the points,
/// `epos98` three.
EstimationResult fit_sphere(const PointView& points, const SphereOptions& options, Sphere& sphere,
                            const Execution& execution = {});

/// Fits the smallest sphere around the points, with a proof. The radius exceeds certificate.lower_bound by at
/// most 1e-12 of the radius, plus the rounding of the stored centre to double (half a unit in the last place
/// of its coordinates). Empty input and errors are as for fit_aabb().
///
/// Larsson, Capannini, Källberg 2016. Computes the smallest ball of a few points, and adds to these the
/// farthest outside point in each octant until no point is outside. The loop always ends. Most clouds take
/// two passes. Further passes mostly inspect only the points near the surface.
EstimationResult fit_smallest_sphere(const PointView& points, Sphere& sphere, SphereCertificate& certificate,
                                     const Execution& execution = {});

/// Computes the convex hull of the points. The vertices are exactly the extreme points of the cloud, which
/// are the points outside the convex hull of all other points (of equal points the first). The triangles are
/// the surface. The offset of each plane is the exact maximum projection of all points on the plane's normal,
/// rounded up. Empty input and errors are as for fit_aabb().
///
/// The hull has the rank of the points (result.h). If the points are flat to 2^-36 of their extent, the
/// vertices are the corners of a polygon, to the same tolerance. The planes still enclose all points.
///
/// Akl, Toussaint 1978 drops the points inside the hull of the extremal points, in O(n). Barber, Dobkin,
/// Huhdanpaa 1996 finds the hull of the m remaining points, usually in O(m log m).
EstimationResult fit_hull(const PointView& points, Hull& hull, const Execution& execution = {});

/// Fits a small cylinder around the points. The axis is the best that a search finds. The search tries
/// directions over the hemisphere and improves the best of them step by step. For this axis, radius and
/// height are the minimum. There is no proof that no other axis is better.
///
/// Empty input and errors are as for fit_hull(). Points in a plane give a disc, points on a line a segment.
/// Takes the time of fit_hull(), plus about a thousand times O(vertices).
EstimationResult fit_cylinder(const PointView& points, Cylinder& cylinder, const Execution& execution = {});

/// Fits a small capsule around the points. The axis is found as for fit_cylinder(). Then each end is as far
/// inward as the points allow. The radius is larger than necessary if that makes the volume smaller. Except
/// for rounding, the volume is never larger than that of the smallest sphere. Empty input, errors and time
/// are as for fit_cylinder().
EstimationResult fit_capsule(const PointView& points, Capsule& capsule, const Execution& execution = {});

/// Fits the smallest ellipsoid around the points, to about 1e-6 of its volume. The certificate proves how
/// near the volume is to the minimum. Empty input and errors are as for fit_hull(). Along directions in which
/// the points are flat, the radius is 2^-30 of the largest radius. For one point all radii are 0. Takes the
/// time of fit_hull(), plus about a hundred to a thousand times O(vertices).
///
/// Khachiyan 1996; Harman, Filova and Richtarik 2020.
EstimationResult fit_ellipsoid(const PointView& points, Ellipsoid& ellipsoid,
                               EllipsoidCertificate& certificate, const Execution& execution = {});

/// As fit_ellipsoid() above, without the certificate.
EstimationResult fit_ellipsoid(const PointView& points, Ellipsoid& ellipsoid,
                               const Execution& execution = {});

}  // namespace pcl_bv
