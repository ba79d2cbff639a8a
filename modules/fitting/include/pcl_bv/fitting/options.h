// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Options of the fits, and the proofs that some fits return. "The paper" is the first entry of
// docs/references.md.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace [[gnu::visibility("default")]] pcl_bv {

/// How a bounding sphere is computed, from the loosest to the tightest. All methods but `exact` compute a
/// first sphere of a few points, then grow it until it encloses all points (SphereGrowth).
enum class SphereMethod : std::uint8_t {
  ritter,  ///< Ritter 1990. The first ball has as a diameter the segment between the two extremal points of a
           ///< coordinate axis. Of the three axes, the one with the longest segment is taken.
  epos6,   ///< Larsson 2008. The smallest ball of the extremal points along the 3 face normals of a cube.
  epos14,  ///< As epos6, with 4 more directions: those through the corners of the cube.
  epos26,  ///< As epos14, with 6 more directions: those through the edges of the cube.
  epos98,  ///< As epos26, with 36 more directions: (0,1,2), (1,1,2), (1,2,2) in all permutations and signs.
  exact    ///< The smallest sphere. The search begins with the extremal points of epos26, and adds the
           ///< farthest outside points to them until no point is outside.
};

/// How a first sphere is enlarged until it encloses all points (the paper, §5). `exact` does not use it.
enum class SphereGrowth : std::uint8_t {
  /// One point after another in the order of the view, in one thread (the paper, Figure 3).
  sequential,
  /// The centre does not move. The radius becomes the largest distance of a point from the centre, computed
  /// in parallel. This is the simplest growth, but its spheres are larger. A point outside the sphere, at the
  /// distance d from it, adds d to the radius. With the other two growths such a point adds only d / 2.
  stationary,
  /// The points outside the first sphere are listed in parallel. Then the sphere grows over these points in
  /// ascending order of their indices. The sphere has the same bits as with `sequential` if the view has no
  /// index list or an ascending one, because points inside the first sphere never make it grow.
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

/// How the axes of an oriented box are chosen.
enum class ObbMethod : std::uint8_t {
  /// The eigenvectors of the covariance. Sensitive to point density, not only to extent.
  pca,
  /// Each triangle of extremal points gives axes along its edges and its normal. Takes the axes whose box has
  /// the smallest surface, or the coordinate axes if their box is not larger (Larsson, Kallberg 2011).
  dito14,
  /// The axes of the smallest volume. If the hull has at most 128 vertices, the volume is the true minimum,
  /// to a relative 1e-10 (O'Rourke 1985). If one side is shorter than 1e-4 of another, this tolerance is
  /// 1e-14 times the longest side divided by the shortest. If rounding prevents the proof, as between sides
  /// that differ by many orders of magnitude, a limit ends the search. For more vertices the volume is the
  /// smallest that a search finds. It is occasionally some percent above the minimum, but never above the
  /// volumes of `pca` and `dito14`.
  minimal,
  /// Axis 2 is up, and the area seen from above is the minimum.
  yaw,
  /// Axis 2 is up, and the points seen from above are as close as possible to the box's sides (Zhang et al.
  /// 2017). The angle is that of the sides by least squares. For vehicles of which a LiDAR sees two sides. For
  /// such vehicles, `yaw` often gives a wrong angle.
  lshape
};

/// Options of fit_obb().
struct ObbOptions {
  // Not explicit, so that a method can be passed alone.
  ObbOptions(ObbMethod m = ObbMethod::minimal, const Eigen::Vector3d& u = Eigen::Vector3d::UnitZ())
      : method(m), up(u) {}

  /// How the axes are chosen.
  ObbMethod method;
  /// The direction against gravity, used by `yaw` and `lshape`. Its length does not matter, but its largest
  /// component must be from 1e-30 to 1e30 in magnitude.
  Eigen::Vector3d up;
};

/// Options of fit_prism().
struct PrismOptions {
  // Not explicit, so that a direction can be passed alone.
  PrismOptions(const Eigen::Vector3d& u = Eigen::Vector3d::UnitZ(),
               double c = std::numeric_limits<double>::infinity())
      : up(u), concave_length(c) {}

  /// The direction against gravity. Its length does not matter, but its largest component must be from 1e-30
  /// to 1e30 in magnitude.
  Eigen::Vector3d up;
  /// Infinity: the outline is the convex hull. Otherwise each edge of the outline that is longer than this
  /// length is replaced by two edges through a point inside the outline, as far as the points allow. So the
  /// outline follows bays that are wider than this length. A bay is a region between the outline and its
  /// convex hull; its width is the edge of the hull that closes it. In the unit of the points, above 0.
  double concave_length;
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
  /// Number of passes that searched for points outside: in a sample of the points, among all points, or among
  /// those near the surface. The pass for the extremal points is not counted.
  int passes = 0;
};

/// Proof that an ellipsoid is nearly the smallest: points p_i of the cloud with weights w_i > 0 whose sum is
/// 1. Let S be the weighted covariance of these points. No ellipsoid around them has a volume below
/// 4 pi / 3 sqrt(27 det S) (Khachiyan 1996).
struct EllipsoidCertificate {
  std::vector<std::size_t> support;  ///< Indices of the points p_i in the cloud.
  std::vector<double> weights;       ///< The weights w_i.
  /// Lower bound of the volume: 4 pi / 3 sqrt(27 det S) less a margin for rounding. 0 for flat points.
  double lower_bound = 0;
  /// Relative excess of the volume over its lower bound: volume / bound - 1. For points of rank 2, areas in
  /// the plane of the points replace the volumes. For points of rank 1, lengths replace them.
  double excess = 0;
  int iterations = 0;  ///< Iterations of the solver.
};

/// The points that touch a k-DOP, as indices in the cloud. If several points touch a side of a slab, the
/// point with the smallest index is stored. Empty without a valid point. The paper, §3.
struct SlabPoints {
  std::vector<std::size_t> min;  ///< For each slab the index of a point on its minimum side.
  std::vector<std::size_t> max;  ///< For each slab the index of a point on its maximum side.
};

}  // namespace pcl_bv
