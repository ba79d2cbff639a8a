// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Lengths with a known side of the error, and what a stored isometry, which is never quite one, does to them.
// What several sources share is in a namespace of its own: other layers have internals with names like these.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "pcl_bv/volumes/aabb.h"

namespace pcl_bv::volumes_internal {

/// |v| and |a - b| in exact arithmetic, rounded up.
double norm_up(const Eigen::Vector3d& v);
double distance_up(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// Whether |a - b| <= r - s by exact arithmetic, for r >= s >= 0. False also where products underflow so far
/// that it cannot be decided.
bool within(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double r, double s);

/// The box of all center + q with |q[i]| <= half[i], by exact arithmetic.
Aabb box_around(const Eigen::Vector3d& center, const Eigen::Vector3d& half);

/// How far axes, in columns, are from orthonormal: the greatest entry of axes' axes - 1 in magnitude. NaN for
/// axes that are not finite.
double skew(const Eigen::Matrix3d& axes);

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
