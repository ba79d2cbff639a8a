// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "pcl_bv/volumes/aabb.h"

namespace pcl_bv {

/// What is not there stays empty.
struct CsvShape {
  std::optional<Eigen::Vector3d> size;  ///< Along the shape's own axes.
  std::optional<Eigen::Quaterniond> rotation;
  std::optional<double> radius;
};

/// A round shape of this whole height along its axis, whichever way that points: upwards the turn from z is
/// well conditioned, and needs no singular value decomposition as Eigen's FromTwoVectors() does.
inline CsvShape round_shape(const Eigen::Vector3d& axis, double radius, double height) {
  const Eigen::Vector3d up = (axis.z() < 0 ? Eigen::Vector3d(-axis) : axis).stableNormalized();
  return {Eigen::Vector3d(2 * radius, 2 * radius, height),
          Eigen::Quaterniond(1 + up.z(), -up.y(), up.x(), 0).normalized(), radius};
}

/// The rotation of three axes in columns, whichever hand they are of: the shape does not change with a sign.
inline Eigen::Quaterniond rotation_of(Eigen::Matrix3d axes) {
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  return Eigen::Quaterniond(axes);
}

/// By the numbers that a shape has, so that one more box or ball needs no line here; else its axis-aligned
/// box.
template <typename Shape>
CsvShape csv_shape(const Shape& shape) {
  if constexpr (requires { shape.half_extents(), shape.quaternion(); }) {
    return {2 * shape.half_extents(), shape.quaternion(), {}};
  } else if constexpr (requires { shape.radii(), shape.axes(); }) {
    return {2 * shape.radii(), rotation_of(shape.axes()), {}};
  } else if constexpr (requires { shape.axis(), shape.half_height(), shape.radius(); }) {
    return round_shape(shape.axis(), shape.radius(), 2 * shape.half_height());
  } else if constexpr (requires { shape.a(), shape.b(), shape.radius(); }) {
    const Eigen::Vector3d along = shape.b() - shape.a();
    const Eigen::Vector3d axis = along.isZero(0) ? Eigen::Vector3d(0, 0, 1) : along;
    return round_shape(axis, shape.radius(), along.stableNorm() + 2 * shape.radius());
  } else if constexpr (requires { shape.radius(); }) {
    return {{}, {}, shape.radius()};
  } else {
    const Aabb box = shape.aabb();
    return {box.max() - box.min(), {}, {}};
  }
}

}  // namespace pcl_bv
