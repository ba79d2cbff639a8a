// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Lengths of vectors with a known side of the error.
// What several sources share is in a namespace of its own: other layers have internals with names like these.
#pragma once

#include <Eigen/Core>

namespace pcl_bv::volumes_internal {

/// |v| and |a - b| in exact arithmetic, rounded up.
double norm_up(const Eigen::Vector3d& v);
double distance_up(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// Whether |a - b| <= r - s by exact arithmetic, for r >= s >= 0. False also where products underflow so far
/// that it cannot be decided.
bool within(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double r, double s);

}  // namespace pcl_bv::volumes_internal
