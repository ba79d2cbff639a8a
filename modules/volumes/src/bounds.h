// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Lengths and products in the whole range of double, and upper bounds of lengths, also of vectors transformed
// by a stored isometry. The matrix of a stored isometry is rarely exactly orthonormal.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "pcl_bv/volumes/aabb.h"

namespace pcl_bv::detail {

/// Returns v / |v| for a vector of any length, and the zero vector for the zero vector.
Eigen::Vector3d unit_vector(const Eigen::Vector3d& v);

/// Returns a * b * c. No product of two factors overflows or underflows if the result does not.
double product_of(double a, double b, double c);

/// Return proven upper bounds of |v| and of |a - b|.
double norm_up(const Eigen::Vector3d& v);
double distance_up(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// Returns whether |a - b| <= r - s, for r >= s >= 0. The comparison has no rounding error. If products
/// underflow so far that it cannot be decided, the result is false.
bool ball_inside_ball(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double r, double s);

/// Returns a box that contains all points center + q with |q[i]| <= half[i], in spite of rounding errors.
Aabb box_around(const Eigen::Vector3d& center, const Eigen::Vector3d& half);

/// Returns the largest magnitude of an entry of axes' * axes - I. It is 0 if the columns of `axes` are
/// orthonormal. NaN if an entry of `axes` is not finite.
double orthonormality_error(const Eigen::Matrix3d& axes);

/// Returns an upper bound of |M v| / |v| over all v, namely sqrt(max row sum of |M'M|), rounded up. The
/// result is 1 for the identity.
double matrix_norm_up(const Eigen::Matrix3d& m);

/// A transformed point, rounded, and an upper bound of its distance from the exact transformed point.
struct PointWithError {
  Eigen::Vector3d point;
  double error;
};
PointWithError transform_point(const Eigen::Isometry3d& transform, const Eigen::Vector3d& p);

/// Returns a proven upper bound of |m v - factor w|.
double difference_up(const Eigen::Matrix3d& m, const Eigen::Vector3d& v, double factor,
                     const Eigen::Vector3d& w);

}  // namespace pcl_bv::detail
