// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Conversion of volumes to the pcl::ModelCoefficients of PCL's visualizer and sample consensus models. All
// coefficients of an empty volume are NaN, except the radius, which is -1.
#pragma once

#include <pcl/ModelCoefficients.h>

#include <initializer_list>

#include "pcl_bv/volumes/cylinder.h"
#include "pcl_bv/volumes/obb.h"
#include "pcl_bv/volumes/sphere.h"

namespace pcl_bv {
namespace detail {

inline pcl::ModelCoefficients as_floats(std::initializer_list<double> values) {
  pcl::ModelCoefficients result;
  for (const double value : values)
    result.values.push_back(static_cast<float>(value));
  return result;
}

}  // namespace detail

/// Returns the coefficients for PCLVisualizer::addCube(): translation x y z, rotation as a quaternion x y z
/// w, and the sizes along axes 0, 1 and 2 of the box. For an upright box these sizes are length, width and
/// height. The coefficients are rounded to float, so the model does not always enclose the box.
inline pcl::ModelCoefficients to_model_coefficients(const Obb& box) {
  const Eigen::Vector3d& c = box.center();
  const Eigen::Vector3d size = box.empty() ? c : Eigen::Vector3d(2 * box.half_extents());
  const Eigen::Vector4d q = box.empty() ? Eigen::Vector4d::Constant(c.x()) : box.quaternion().coeffs();
  return detail::as_floats(
      {c.x(), c.y(), c.z(), q.x(), q.y(), q.z(), q.w(), size.x(), size.y(), size.z()});
}

/// Returns the coefficients for PCLVisualizer::addSphere() and SACMODEL_SPHERE, namely centre and radius of
/// Sphere::cast_float(), which encloses the sphere.
inline pcl::ModelCoefficients to_model_coefficients(const Sphere& sphere) {
  const Eigen::Vector3d& c = sphere.center();
  if (sphere.empty()) return detail::as_floats({c.x(), c.y(), c.z(), -1});
  const FloatSphere f = sphere.cast_float();
  return detail::as_floats({f.center.x(), f.center.y(), f.center.z(), f.radius});
}

/// Returns the coefficients for PCLVisualizer::addCylinder() and SACMODEL_CYLINDER: the centre as a point on
/// the axis, the direction of the axis, and the radius. The model is an infinite cylinder, without ends.
/// Rounding to float moves the axis. The radius is inflated by the largest such movement between the ends of
/// the cylinder, so the model encloses the cylinder.
inline pcl::ModelCoefficients to_model_coefficients(const Cylinder& cylinder) {
  const FloatCylinder f = cylinder.cast_float();
  return detail::as_floats(
      {f.center.x(), f.center.y(), f.center.z(), f.axis.x(), f.axis.y(), f.axis.z(), f.radius});
}

}  // namespace pcl_bv
