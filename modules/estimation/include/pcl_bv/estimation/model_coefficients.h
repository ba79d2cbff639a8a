// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Volumes in the form that PCL's visualizer and its sample consensus models take.
#pragma once

#include <pcl/ModelCoefficients.h>

#include "pcl_bv/volumes/obb.h"
#include "pcl_bv/volumes/sphere.h"

namespace pcl_bv {

/// As PCLVisualizer::addCube() takes it: translation x y z, rotation as a quaternion x y z w, and the sizes
/// along the box's axes 0, 1 and 2. Rounded to float, so not a bound. Ten NaN for an empty box.
inline pcl::ModelCoefficients to_model_coefficients(const Obb& box) {
  const Eigen::Vector3d& c = box.center();
  const Eigen::Vector3d size = box.empty() ? c : Eigen::Vector3d(2 * box.half_extents());
  const Eigen::Vector4d q = box.empty() ? Eigen::Vector4d::Constant(c.x()) : box.quaternion().coeffs();
  pcl::ModelCoefficients result;
  for (const double value : {c.x(), c.y(), c.z(), q.x(), q.y(), q.z(), q.w(), size.x(), size.y(), size.z()})
    result.values.push_back(static_cast<float>(value));
  return result;
}

/// As PCLVisualizer::addSphere() and SACMODEL_SPHERE take it: centre x y z and radius. Rounded to float, so
/// not a bound. An empty sphere: NaN three times and -1.
inline pcl::ModelCoefficients to_model_coefficients(const Sphere& sphere) {
  const Eigen::Vector3d& c = sphere.center();
  pcl::ModelCoefficients result;
  for (const double value : {c.x(), c.y(), c.z(), sphere.radius()})
    result.values.push_back(static_cast<float>(value));
  return result;
}

}  // namespace pcl_bv
