// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Geometry>

#include "image.h"
#include "pcl_bv/trees/point_tree.h"

namespace pcl_bv {

/// Whether a point is within `distance` of a place, of which the image is given, as image_of() has it. Never
/// false where one is, also if the distance is rounded twice; errs by 2^-48 of the distance and by the
/// image's error. Of an error and a distance both below 2^-500 squares may underflow.
bool any_within(const PointTree& points, const Image& place, double distance);

/// within() of collision.h, for two trees that have points.
bool trees_within(const PointTree& points, const PointTree& others, const Eigen::Isometry3d& pose,
                  double margin);

}  // namespace pcl_bv
