// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Geometry>

#include "pcl_bv/trees/point_tree.h"

namespace pcl_bv {

/// within() of collision.h, for two trees that have points.
bool trees_within(const PointTree& points, const PointTree& others, const Eigen::Isometry3d& pose,
                  double margin);

}  // namespace pcl_bv
