// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What a stored isometry, which is never quite one, does to points and lengths.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pcl_bv::volumes_internal {

/// How much the matrix stretches any vector: |M| <= sqrt(max row sum of |M'M|), rounded up; 1 for the
/// identity.
double stretch_up(const Eigen::Matrix3d& m);

/// The image of a point, rounded, and an upper bound of its distance from the exact one.
struct MovedPoint {
  Eigen::Vector3d point;
  double error;
};
MovedPoint move_point(const Eigen::Isometry3d& transform, const Eigen::Vector3d& p);

/// An upper bound of |m v - factor w|, by exact arithmetic.
double difference_up(const Eigen::Matrix3d& m, const Eigen::Vector3d& v, double factor,
                     const Eigen::Vector3d& w);

}  // namespace pcl_bv::volumes_internal
