// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "local_frame.h"
#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/fitting/summary.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/volumes/obb.h"
#include "small_vector.h"

namespace pcl_bv {

/// A box along the axes around all valid points, of which there must be one: by exact arithmetic,
/// and tight to a few units in the last place of the extents and of the centre. Columns unit and orthogonal
/// to 1e-12; `supports` along any set. Needs a FloatEnvironment.
Obb measured_box(const Eigen::Matrix3d& axes, const PointView& points, const Supports& supports,
                 const Execution& execution);

/// Eigenvectors of the covariance, that of the greatest eigenvalue first.
Eigen::Matrix3d principal_axes(const CloudSummary& summary);

/// Axes of which the first is `e`, a unit vector.
Eigen::Matrix3d axes_from(const Eigen::Vector3d& e);

/// A few points in local coordinates.
using FewPoints = SmallVector<Eigen::Vector3d, 32>;

/// The points of both ends of all directions, or, of no more points than that, all valid ones.
FewPoints few_points(const PointView& points, const Supports& supports, const LocalFrame& frame);

/// The axes of least half surface, measured on 'few' in floats, among the coordinate axes and those of DiTO's
/// triangles (Larsson, Kallberg 2011). `supports` along dop14, with points, and `few` of them.
Eigen::Matrix3d dito_axes(const FewPoints& few, const Supports& supports, const LocalFrame& frame);

/// The axes of the least box that a search over the hull finds. `summary` of the same points.
Eigen::Matrix3d minimal_axes(const PointView& points, const CloudSummary& summary, const LocalFrame& frame,
                             const Execution& execution);

/// Axes of which one is `up`, a unit vector; the others as the least area from above wants them, or the
/// closeness of the sides. `supports` along dop26, with points.
Eigen::Matrix3d yaw_axes(const PointView& points, const Supports& supports, const LocalFrame& frame,
                         const Eigen::Vector3d& up, const Execution& execution);
Eigen::Matrix3d lshape_axes(const PointView& points, const Supports& supports, const LocalFrame& frame,
                            const Eigen::Vector3d& up, const Execution& execution);

}  // namespace pcl_bv
