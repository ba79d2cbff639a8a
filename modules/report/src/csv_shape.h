// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The CSV columns that depend on the type of a shape, which are size, rotation and radius.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/shortest_rotation.h"

namespace pcl_bv::detail {

/// The columns of a shape. Empty columns are nullopt.
struct CsvShape {
  std::optional<Eigen::Vector3d> size;  ///< Along the shape's own axes.
  std::optional<Eigen::Quaterniond> rotation;
  std::optional<double> radius;
};

/// Returns the columns of a cylinder or capsule. `height` is its full height. The axis is flipped to point
/// upwards, which does not change the shape.
inline CsvShape round_shape(const Eigen::Vector3d& axis, double radius, double height) {
  const Eigen::Vector3d up = (axis.z() < 0 ? Eigen::Vector3d(-axis) : axis).stableNormalized();
  return {Eigen::Vector3d(2 * radius, 2 * radius, height), shortest_rotation(Eigen::Vector3d::UnitZ(), up),
          radius};
}

/// Returns the rotation from the world's axes to three orthogonal axes (columns). If the axes are
/// left-handed, the third axis is flipped, which does not change the shape.
inline Eigen::Quaterniond rotation_of(Eigen::Matrix3d axes) {
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  return Eigen::Quaterniond(axes);
}

/// Returns the columns of a shape. The shape's member functions select the columns, so further shapes with
/// the same functions are supported. A shape without these functions gives the size of its axis-aligned box.
template <typename Shape>
CsvShape csv_shape(const Shape& shape) {
  if constexpr (requires { shape.half_extents(), shape.quaternion(); }) {
    return {2 * shape.half_extents(), shape.quaternion(), {}};
  } else if constexpr (requires { shape.outline(), shape.axes(); }) {
    const auto& outline = shape.outline();
    Eigen::Vector2d low = outline.front(), high = low;
    for (const Eigen::Vector2d& corner : outline) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    const Eigen::Vector2d size = high - low;
    return {Eigen::Vector3d(size.x(), size.y(), shape.high() - shape.low()), rotation_of(shape.axes()), {}};
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

}  // namespace pcl_bv::detail
