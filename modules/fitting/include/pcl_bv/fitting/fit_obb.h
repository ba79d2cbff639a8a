// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Oriented boxes: five methods to choose the axes. Along the axes, all boxes are measured in the same way.
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
  /// Larsson, Kallberg 2011: frames given by triangles of extremal points; the one with the smallest surface.
  /// The axis-aligned box if its surface is smaller.
  dito14,
  /// The smallest volume. If the hull has at most 128 vertices, it is the true minimum, to a relative 1e-10
  /// (O'Rourke 1985; if one side is shorter than 1e-4 of another, to 1e-14 times the ratio of the sides). For
  /// more vertices it is the smallest volume that a search finds: occasionally some percent above the
  /// minimum, never above `pca` and `dito14`.
  minimal,
  /// Upright: axis 2 is up, and the area seen from above is the minimum.
  yaw,
  /// Upright: axis 2 is up, and the points seen from above are as close as possible to the box's sides (Zhang
  /// et al. 2017). For vehicles of which a LiDAR sees two sides: the minimum area often turns these wrongly.
  lshape
};

/// Options of fit_obb().
struct ObbOptions {
  // Not explicit, so that a method can be passed alone.
  ObbOptions(ObbMethod m = ObbMethod::minimal, const Eigen::Vector3d& u = Eigen::Vector3d::UnitZ())
      : method(m), up(u) {}

  /// How the axes are chosen.
  ObbMethod method;
  /// For `yaw` and `lshape`: the direction against gravity. Any length, with the largest component from 1e-30
  /// to 1e30 in magnitude.
  Eigen::Vector3d up;
};

/// Fits an oriented box around the points, centre and half extents in the points' unit.
///
/// The axes are in the order of Obb::canonical(); those of `yaw` and `lshape` in the order of
/// Obb::upright(up): axis 2 is up and axis 0 the longer horizontal one, so the sizes along axes 0, 1 and 2
/// are length, width and height. For every method, the box is measured along its axes on all points: it
/// encloses each point by exact arithmetic and is tight along each axis, except for the rounding of its
/// centre.
///
/// Empty input, or no finite point: an empty box and `no_valid_points`. One point: a box with half extents 0.
/// Points on a line or in a plane, to 1e-10 of their extent: a box along it, only as thick as rounding. The
/// same bits for every execution.
///
/// O(n): two passes for `pca` and `dito14`, three for the others. These also take O(m log m) for m points:
/// `minimal` for those near the hull, `yaw` and `lshape` for those near the outline seen from above.
/// `minimal` takes some milliseconds for a round hull of 128 vertices, and as much for one of hundreds, which
/// it searches less thoroughly. Throws std::invalid_argument for an `up` outside its range; other errors as
/// for fit_aabb().
EstimationResult fit_obb(const PointView& points, const ObbOptions& options, Obb& box,
                         const Execution& execution = {});

}  // namespace pcl_bv
