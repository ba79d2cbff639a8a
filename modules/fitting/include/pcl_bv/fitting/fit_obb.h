// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits oriented boxes. Five methods choose the axes. Along the axes, all boxes are measured in the same way.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/fitting/result.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/obb.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// How the axes of an oriented box are chosen.
enum class ObbMethod : std::uint8_t {
  /// The eigenvectors of the covariance. Sensitive to point density, not only to extent.
  pca,
  /// Of the frames given by triangles of extremal points, the one with the smallest surface (Larsson,
  /// Kallberg 2011). The coordinate axes if their box has a smaller surface.
  dito14,
  /// The axes of the smallest volume. If the hull has at most 128 vertices, the volume is the true minimum,
  /// to a relative 1e-10 (O'Rourke 1985). If one side is shorter than 1e-4 of another, this tolerance is
  /// 1e-14 times the ratio of the sides. For more vertices the volume is the smallest that a search finds. It
  /// is occasionally some percent above the minimum, but never above the volumes of `pca` and `dito14`.
  minimal,
  /// Axis 2 is up, and the area seen from above is the minimum.
  yaw,
  /// Axis 2 is up, and the points seen from above are as close as possible to the box's sides (Zhang et al.
  /// 2017). For vehicles of which a LiDAR sees two sides, because `yaw` often turns these wrongly.
  lshape
};

/// Options of fit_obb().
struct ObbOptions {
  // Not explicit, so that a method can be passed alone.
  ObbOptions(ObbMethod m = ObbMethod::minimal, const Eigen::Vector3d& u = Eigen::Vector3d::UnitZ())
      : method(m), up(u) {}

  /// How the axes are chosen.
  ObbMethod method;
  /// The direction against gravity, used by `yaw` and `lshape`. It may have any length. Its largest component
  /// must be from 1e-30 to 1e30 in magnitude.
  Eigen::Vector3d up;
};

/// Fits an oriented box around the points. Centre and half extents are in the points' unit.
///
/// The axes are in the order of Obb::canonical(). Those of `yaw` and `lshape` are in the order of
/// Obb::upright(up): axis 2 is up, and axis 0 is the longer horizontal axis. The sizes along axes 0, 1 and 2
/// are then length, width and height. For every method, the box is measured along its axes on all points. It
/// encloses each point by exact arithmetic and is tight along each axis, except for the rounding of its
/// centre.
///
/// If there is no valid point, the box is empty and the status is `no_valid_points`. One point gives a box
/// with half extents 0. Points on a line or in a plane, to 1e-10 of their extent, give a box along this line
/// or plane that is only as thick as rounding. The bits are the same for every execution.
///
/// O(n): two passes for `pca` and `dito14`, three for the other methods. These also take O(m log m) for m
/// points. For `minimal` these are the points near the hull, for `yaw` and `lshape` the points near the
/// outline seen from above. `minimal` takes some milliseconds for a round hull of 128 vertices. It takes as
/// long for a hull of hundreds of vertices, which it searches less thoroughly. Throws std::invalid_argument
/// for an `up` outside its range. Other errors are as for fit_aabb().
EstimationResult fit_obb(const PointView& points, const ObbOptions& options, Obb& box,
                         const Execution& execution = {});

}  // namespace pcl_bv
