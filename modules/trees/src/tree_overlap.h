// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tests whether points of two trees are near each other.
#pragma once

#include <Eigen/Geometry>

#include "pcl_bv/trees/point_tree.h"
#include "transformed_point.h"

namespace pcl_bv::detail {

/// Returns whether any point of the tree is within `distance` of the exact transformed point that `point`
/// approximates (see transform_point()). The result is always true if such a point exists, even if `distance`
/// is too small by two roundings. The result may also be true if all points are farther away than `distance`,
/// by at most 2^-48 of the distance plus twice the error of `point`. No square underflows unless both the
/// error and the distance are below 2^-500.
bool any_within(const PointTree& points, const TransformedPoint& point, double distance);

/// Implements within() of collision.h for two trees that have points.
bool trees_within(const PointTree& points, const PointTree& others, const Eigen::Isometry3d& pose,
                  double margin);

}  // namespace pcl_bv::detail
