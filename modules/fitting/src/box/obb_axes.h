// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The axes of oriented boxes for each method, and the measurement of the box along its axes.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "local_frame.h"
#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/volumes/obb.h"
#include "small_vector.h"
#include "summary.h"

namespace pcl_bv::detail {

/// Returns the box along the axes around all valid points. There must be at least one valid point. In exact
/// arithmetic, the box encloses the points. It is tight to a few units in the last place of the extents and
/// of the centre. The columns of `axes` must be orthonormal to 1e-12. `supports` may have any set. Needs a
/// FloatEnvironment.
Obb measured_box(const Eigen::Matrix3d& axes, const PointView& points, const Supports& supports,
                 const FitExecution& execution);

/// Returns the eigenvectors of the covariance, in descending order of the eigenvalues.
Eigen::Matrix3d principal_axes(const CentroidAndCovariance& points);

/// Returns orthonormal axes, the first of which is `e`, a unit vector.
Eigen::Matrix3d axes_from(const Eigen::Vector3d& e);

/// A few points in local coordinates.
using FewPoints = SmallVector<Eigen::Vector3d, 32>;

/// Returns the support points of all directions, two for each direction. If the cloud has at most this number
/// of points, returns all valid points instead.
FewPoints support_or_all_points(const PointView& points, const Supports& supports, const LocalFrame& frame);

/// Returns the axes with the smallest half surface among the coordinate axes and the axes of DiTO's triangles
/// (Larsson, Kallberg 2011). The surface is measured on `few` in floats. `supports` must have the set dop14
/// and SupportDetail::points. `few` must be the result of support_or_all_points().
Eigen::Matrix3d dito_axes(const FewPoints& few, const Supports& supports, const LocalFrame& frame);

/// Returns the axes of the smallest box around the points. If the hull has more than 128 vertices, the axes
/// are those of the smallest box that a search finds. `summary` must be of the same points.
Eigen::Matrix3d minimal_axes(const PointView& points, const Summary& summary, const LocalFrame& frame,
                             const FitExecution& execution);

/// Both functions return axes. The first axis is `up`, a unit vector. The axes of yaw_axes() give the box
/// with the minimum area seen from above. The axes of lshape_axes() give the box with the sides closest to
/// the points. `supports` must have the set dop26 and SupportDetail::points.
Eigen::Matrix3d yaw_axes(const PointView& points, const Supports& supports, const LocalFrame& frame,
                         const Eigen::Vector3d& up, const FitExecution& execution);
Eigen::Matrix3d lshape_axes(const PointView& points, const Supports& supports, const LocalFrame& frame,
                            const Eigen::Vector3d& up, const FitExecution& execution);

}  // namespace pcl_bv::detail
