// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Oriented boxes: five ways to choose the axes, one way to measure along them.
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
  pca,  ///< The eigenvectors of the covariance. Where the points lie dense decides, not how far they reach.
  dito14,  ///< Larsson, Kallberg 2011: the frame of a triangle of extremal points that has the least surface;
           ///< the axis-aligned box where that has less.
  minimal,  ///< The least volume. Of a hull of at most 128 vertices the smallest there is, to 1e-10 of it
            ///< (O'Rourke 1985; where a side is under 1e-4 of another, to 1e-14 of their ratio). Of more
            ///< vertices the least that a search finds: now and then some percent above the smallest, never
            ///< above the two before.
  yaw,      ///< Upright: axis 2 is up, and the area seen from above is the least there is.
  lshape    ///< Upright: the points seen from above are as close as can be to the box's sides (Zhang et al.
            ///< 2017). For vehicles of which a LiDAR sees two sides, which the least area often turns wrong.
};

/// What fit_obb() is asked for.
struct ObbOptions {
  // Not explicit: a method alone says enough.
  ObbOptions(ObbMethod m = ObbMethod::minimal, const Eigen::Vector3d& u = Eigen::Vector3d::UnitZ())
      : method(m), up(u) {}

  ObbMethod method;
  Eigen::Vector3d up;  ///< For `yaw` and `lshape`: against gravity, of any length from 1e-30 to 1e30.
};

/// An oriented box around the points, centre and half extents in the points' unit. Its axes are canonical();
/// those of `yaw` and `lshape` are upright(up): axis 2 is up, axis 0 the longer horizontal one, so that the
/// sizes along axes 0, 1 and 2 are length, width and height. Whatever chose the axes, the box is measured
/// along them on all points: it encloses each by exact arithmetic and is tight along each axis but for the
/// rounding of its centre.
///
/// Empty input or no finite point: an empty box and `no_valid_points`. One point: a box of half extents 0.
/// Points on a line or in a plane, to 1e-10 of their extent: a box along it, thin as rounding. The same bits
/// for every execution.
///
/// O(n) in two passes for `pca` and `dito14`, three for the others, and for those O(m log m) besides for the
/// m points that are near the hull, or near its outline from above. `minimal` takes some
/// milliseconds for a round hull of 128 vertices, and for one of hundreds, which it searches less thoroughly.
/// Throws std::invalid_argument for an `up` outside its range, and otherwise as fit_sphere().
EstimationResult fit_obb(const PointView& points, const ObbOptions& options, Obb& box,
                         const Execution& execution = {});

}  // namespace pcl_bv
