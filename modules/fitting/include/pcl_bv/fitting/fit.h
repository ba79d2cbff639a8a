// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits of bounding volumes to points. Every fit takes the points, then its options, then the execution. In
// exact real arithmetic, each valid point is inside the returned volume. The result has the same bits for
// every instruction set and every number of threads (docs/numerics.md). "The paper" is the first entry of
// docs/references.md.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "pcl_bv/fitting/options.h"
#include "pcl_bv/fitting/result.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/any_volume.h"
#include "pcl_bv/volumes/capsule.h"
#include "pcl_bv/volumes/cylinder.h"
#include "pcl_bv/volumes/ellipsoid.h"
#include "pcl_bv/volumes/hull.h"
#include "pcl_bv/volumes/kdop.h"
#include "pcl_bv/volumes/obb.h"
#include "pcl_bv/volumes/prism.h"
#include "pcl_bv/volumes/sphere.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Fits the axis-aligned box of the points: their exact minimum and maximum. The paper, §2.
///
/// If there is no valid point, the box is empty and the status is `no_valid_points`. One point gives a box of
/// that point only. O(n) in one pass. Computing the rank of flat points takes up to five more passes.
/// Exceptions of the points' source (PointView::source) are passed on.
Fitted<Aabb> fit_aabb(const PointView& points, const Execution& execution = {});

/// Fits the k-DOP of the points along the directions of `set` (not null). Each slab is the exact minimum and
/// maximum projection. A projection that no double represents is rounded outward to the next double. The
/// paper, §2, Figure 2.
///
/// Empty input and errors are as for fit_aabb(). A null set throws std::invalid_argument, too. Where a
/// projection is rounded, the slab of a flat cloud can be one rounding step wide. O(n) for each direction.
/// Sets of user-defined directions take about twice the time of the built-in sets, and one more pass.
Fitted<Kdop> fit_kdop(const PointView& points, const std::shared_ptr<const KdopSet>& set = KdopSet::dop26(),
                      const Execution& execution = {});

/// A k-DOP and the points that touch it.
struct KdopWithContacts : Fitted<Kdop> {
  SlabPoints contacts;  ///< For each slab the points on its two sides.
};

/// Fits the k-DOP as fit_kdop() does, and finds the points that touch its slabs. Takes about the time of
/// fit_kdop(). For KdopSet::dop6() it takes about four times as long.
KdopWithContacts fit_kdop_with_contacts(const PointView& points,
                                        const std::shared_ptr<const KdopSet>& set = KdopSet::dop26(),
                                        const Execution& execution = {});

/// Fits a sphere around the points. Centre and radius are in the points' unit. The paper, §3. Empty input and
/// errors are as for fit_aabb(). One point or equal points give radius 0. For `exact` see
/// fit_smallest_sphere(). `epos98` takes three passes over the points, `ritter` and the other EPOS methods
/// take two.
Fitted<Sphere> fit_sphere(const PointView& points, const SphereOptions& options = {},
                          const Execution& execution = {});

/// Fits the smallest sphere around the points, with a proof. The radius exceeds certificate.lower_bound by at
/// most 1e-12 of the radius, plus the rounding of the stored centre to double (half a unit in the last place
/// of its coordinates). Empty input and errors are as for fit_aabb().
///
/// Larsson, Capannini, Källberg 2016. Computes the smallest ball of a few points, adds the farthest outside
/// point in each octant to these few points, and repeats this until no point is outside. The loop always
/// ends. A large cloud first takes passes over a sample of its points. Most clouds take two passes over all
/// points. Further passes mostly inspect only the points near the surface.
Certified<Sphere, SphereCertificate> fit_smallest_sphere(const PointView& points,
                                                         const Execution& execution = {});

/// Fits an oriented box around the points. Centre and half extents are in the points' unit.
///
/// For `pca`, `dito14` and `minimal`, the axes are in the order of Obb::canonical(). For `yaw` and `lshape`,
/// they are in the order of Obb::upright(up): axis 2 is up, and axis 0 is the longer horizontal axis. The
/// sizes along axes 0, 1 and 2 are then length, width and height. Every method finds axes first. Then it
/// measures the box along these axes on all points. In exact arithmetic, the box encloses each point. The box
/// is tight along each axis, except for the rounding of its centre.
///
/// If there is no valid point, the box is empty and the status is `no_valid_points`. One point gives a box
/// with half extents 0. Points that are on a line or in a plane, to 1e-10 of their extent, give a box along
/// this line or plane. Rounding makes the box hardly thicker than the points. The bits are the same for every
/// execution.
///
/// O(n): two passes for `pca` and `dito14`, three for the other methods. For m of the points, these other
/// methods also take O(m log m). For `minimal`, these m points are near the hull. For `yaw` and `lshape`,
/// they are near the outline seen from above. `minimal` takes some milliseconds for a round hull of 128
/// vertices. A hull of hundreds of vertices takes no longer: beyond 128 vertices, `minimal` does not compare
/// all pairs of edges, but searches. Throws std::invalid_argument for an `up` outside its range. Other errors
/// are as for fit_aabb().
Fitted<Obb> fit_obb(const PointView& points, const ObbOptions& options = {}, const Execution& execution = {});

/// Computes the convex hull of the points. The vertices are exactly the extreme points of the cloud, which
/// are the points outside the convex hull of all other points. Of several equal points only the first can be
/// a vertex. The triangles are the surface. The offset of each plane is the exact maximum projection of all
/// points on the plane's normal, rounded up. Empty input and errors are as for fit_aabb().
///
/// The hull has the rank of the points (result.h). If the points are in a plane to 2^-36 of their extent, the
/// vertices are the corners of a polygon, to the same tolerance. The planes still enclose all points.
///
/// First drops the points inside the hull of the extremal points, in O(n) (Akl, Toussaint 1978). Then
/// computes the hull of the m remaining points, usually in O(m log m) (Barber, Dobkin, Huhdanpaa 1996).
Fitted<Hull> fit_hull(const PointView& points, const Execution& execution = {});

/// Fits an upright prism around the points. By default its outline is the exact convex hull of the points
/// seen from above. Its heights are the exact minimum and maximum along `up`. Coordinates are in the points'
/// unit.
///
/// If `up` is a coordinate axis, the corners of the outline are coordinates of points, and no smaller prism
/// along this axis encloses the points. Otherwise the coordinates along the axes are usually no doubles, so
/// the outline and the heights are rounded outward, by a few units in the last place of the coordinates. The
/// rank is that of the points. Points that are flat seen from above give an outline of one or two corners if
/// `up` is a coordinate axis, otherwise an outline that is a few rounding steps wide.
///
/// With PrismOptions::concave_length, the outline need not be convex (Duckham et al. 2008). It is a simple
/// polygon that contains all points. If `up` is a coordinate axis, its corners are points, and its area is
/// not larger than that of the convex hull. Two walls without thickness keep their convex hull: the outline
/// between them would touch itself. If `up` is no coordinate axis, the outline is the convex hull also if
/// rounding could make two of its edges meet, or if one of its angles, inside or outside, is below 0.11
/// degrees.
///
/// Empty input and errors are as for fit_aabb(). Throws std::invalid_argument for an `up` or a concave_length
/// outside its range, too. The bits are the same for every execution and every order of the points.
///
/// O(n): two passes, and a third one if `up` is no coordinate axis. O(m log m) for the m points near the
/// outline (Akl, Toussaint 1978; Andrew 1979). A concave outline needs another pass, O(n log n), and memory
/// for the positions of all points. Each of its e edges takes O(e), and O(1) for each of at most 2^16 cells
/// of a grid and for each point in the cells near the edge. The worst case is O(n^2): if one far outlier puts
/// all other points into one cell, or if concave_length is below the distance between neighbouring points.
Fitted<Prism> fit_prism(const PointView& points, const PrismOptions& options = {},
                        const Execution& execution = {});

/// Fits a small cylinder around the points. The axis is the best that a search finds. The search tries
/// directions over the hemisphere and improves the best of them step by step. For this axis, radius and
/// height are the minimum. There is no proof that no other axis is better.
///
/// Empty input and errors are as for fit_hull(). Points in a plane give a disc, points on a line a segment.
/// Takes the time of fit_hull(), plus about a thousand times O(vertices).
Fitted<Cylinder> fit_cylinder(const PointView& points, const Execution& execution = {});

/// Fits a small capsule around the points. The axis is found as for fit_cylinder(). Then each end of the
/// capsule's segment is moved inward as far as the points allow. A larger radius than necessary is chosen if
/// it makes the volume smaller. Except for rounding, the volume is never larger than that of the smallest
/// sphere. Empty input, errors and time are as for fit_cylinder().
Fitted<Capsule> fit_capsule(const PointView& points, const Execution& execution = {});

/// Fits the smallest ellipsoid around the points, to about 1e-6 of its volume. Empty input and errors are as
/// for fit_hull(). Along directions in which the points are flat, the radius is 2^-30 of the largest radius.
/// For one point all radii are 0. Takes the time of fit_hull(), plus about a hundred to a thousand times
/// O(vertices).
///
/// Khachiyan 1996; Harman, Filova and Richtarik 2020.
Fitted<Ellipsoid> fit_ellipsoid(const PointView& points, const Execution& execution = {});

/// Fits the ellipsoid of fit_ellipsoid(). The certificate proves how near the ellipsoid's volume is to the
/// minimum.
Certified<Ellipsoid, EllipsoidCertificate> fit_smallest_ellipsoid(const PointView& points,
                                                                  const Execution& execution = {});

/// The following functions fit one volume to each cluster. Element i of the result is the fit to the points
/// whose indices are in list i of `clusters`. It has the same bits as a single fit to these points. A cluster
/// whose fit fails does not affect the others. The clusters are distributed over the threads as
/// for_each_view() describes. Throws std::out_of_range for an index outside the cloud, before any fit.
std::vector<Fitted<Aabb>> fit_aabb(const PointView& points, const IndexLists& clusters,
                                   const Execution& execution = {});
std::vector<Fitted<Kdop>> fit_kdop(const PointView& points, const IndexLists& clusters,
                                   const std::shared_ptr<const KdopSet>& set = KdopSet::dop26(),
                                   const Execution& execution = {});
std::vector<Fitted<Sphere>> fit_sphere(const PointView& points, const IndexLists& clusters,
                                       const SphereOptions& options = {}, const Execution& execution = {});
std::vector<Fitted<Obb>> fit_obb(const PointView& points, const IndexLists& clusters,
                                 const ObbOptions& options = {}, const Execution& execution = {});
std::vector<Fitted<Hull>> fit_hull(const PointView& points, const IndexLists& clusters,
                                   const Execution& execution = {});
std::vector<Fitted<Prism>> fit_prism(const PointView& points, const IndexLists& clusters,
                                     const PrismOptions& options = {}, const Execution& execution = {});
std::vector<Fitted<Cylinder>> fit_cylinder(const PointView& points, const IndexLists& clusters,
                                           const Execution& execution = {});
std::vector<Fitted<Capsule>> fit_capsule(const PointView& points, const IndexLists& clusters,
                                         const Execution& execution = {});
std::vector<Fitted<Ellipsoid>> fit_ellipsoid(const PointView& points, const IndexLists& clusters,
                                             const Execution& execution = {});

/// Calls fit(i, execution) once for each view i, in any order and on the threads of the execution's policy.
///
/// Large views, which have 200 000 points or more, are fitted first, one after another. Each fit of a large
/// view uses all threads of the policy. Each fit of a smaller view gets Serial. Then one smaller view of
/// middle size is fitted and timed. If the other smaller views together would take too little time to be
/// worth a second thread, the calling thread fits them all. Otherwise they are distributed over the threads,
/// the largest first.
///
/// If fits of smaller views throw, all other smaller views are still fitted, and one of the exceptions is
/// rethrown; which one is not specified. If the fit of a large view or of the timed view throws, no further
/// view is fitted.
void for_each_view(const std::vector<PointView>& views,
                   const std::function<void(std::size_t, const Execution&)>& fit, const Execution& execution);

/// Result of verify().
struct Verification {
  std::size_t checked = 0;  ///< Number of valid points, all of which are checked.
  std::size_t outside = 0;  ///< Number of valid points outside the volume, counted by exact tests.
  /// The largest distance by which a point is beyond a face or curved surface of the volume, in the points'
  /// unit. 0 if no point is outside. Infinity if the volume is empty and there is a valid point.
  double max_violation = 0;
};

/// Checks for every valid point whether it is inside the volume. The test is exact for the stored parameters
/// of the volume. First, double arithmetic with a rigorous error bound proves for most inside points that
/// they are inside. Rational arithmetic decides all other points. O(n).
Verification verify(const AnyVolume& volume, const PointView& points, const Execution& execution = {});

/// Box, k-DOP, centroid and covariance of a cloud, in the points' unit and frame. Without a valid point,
/// centroid and covariance are zero and the volumes are empty.
struct CloudSummary : EstimationResult {
  Aabb aabb;   ///< The box of fit_aabb().
  Kdop dop26;  ///< The k-DOP of fit_kdop() along the 13 directions of KdopSet::dop26().

  /// Mean of the valid points, which is inside their box. For at most 2^b blocks of 1024 points, the error of
  /// a coordinate is at most (175 + 30 b) 2^-53 of the extent, plus one rounding of the coordinate.
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();

  /// Covariance of the valid points about their centroid, times covariance_scale². Sums are divided by n, not
  /// by n - 1. The matrix is symmetric. Let b be as for `centroid` and f = 3 (175 + 30 b) 2^-53. The error of
  /// entry (i, j) is at most f times the product of the extents along i and j, plus 2^-1073 if the entry
  /// underflows. f is 6e-14 for one block and 2e-13 for 30 million points. Entries of an axis on which all
  /// points have the same coordinate are exactly 0.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  /// Factor by which the points were multiplied for the covariance. It is 1, except for clouds of doubles
  /// whose largest extent is below 1e-99. For such clouds it is a larger power of two, because squares of
  /// their coordinates could underflow. The eigenvectors of the covariance do not depend on this factor.
  double covariance_scale = 1;
};

/// Computes the box, the k-DOP, the centroid and the covariance of all valid points. O(n). Each chunk is read
/// from memory once: its extreme points and its moments are computed while the chunk is in the cache. The
/// bits are the same for every execution. Another order of the points may round centroid and covariance
/// differently.
///
/// In each block of 1024 points, the coordinates are taken relative to one point of the block, and their
/// products are summed. The sums of the blocks are added in pairs (Chan, Golub, LeVeque 1983).
CloudSummary summarize(const PointView& points, const Execution& execution = {});

}  // namespace pcl_bv
