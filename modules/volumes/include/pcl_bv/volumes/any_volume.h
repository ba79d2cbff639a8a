// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string_view>
#include <variant>

#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/capsule.h"
#include "pcl_bv/volumes/cylinder.h"
#include "pcl_bv/volumes/ellipsoid.h"
#include "pcl_bv/volumes/geometry.h"
#include "pcl_bv/volumes/hull.h"
#include "pcl_bv/volumes/kdop.h"
#include "pcl_bv/volumes/obb.h"
#include "pcl_bv/volumes/prism.h"
#include "pcl_bv/volumes/sphere.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A volume of any kind.
using AnyVolume = std::variant<Aabb, Kdop, Sphere, Obb, Cylinder, Capsule, Ellipsoid, Hull, Prism>;

/// Each function below calls the stored volume's member function of the same name.
bool empty(const AnyVolume& volume);
bool contains(const AnyVolume& volume, const Eigen::Vector3d& point);
double volume(const AnyVolume& volume);
double surface_area(const AnyVolume& volume);
Eigen::Vector3d center(const AnyVolume& volume);
Eigen::Vector3d support(const AnyVolume& volume, const Eigen::Vector3d& direction);
double distance(const AnyVolume& volume, const Eigen::Vector3d& point);
std::optional<RayInterval> intersect(const AnyVolume& volume, const Eigen::Vector3d& origin,
                                     const Eigen::Vector3d& direction);
Aabb aabb(const AnyVolume& volume);
Mesh mesh(const AnyVolume& volume);
AnyVolume transformed(const AnyVolume& volume, const Eigen::Isometry3d& transform);

/// Returns the name of the volume's type as used in results: "aabb", "kdop", "sphere", "obb", "cylinder",
/// "capsule", "ellipsoid", "hull" or "prism".
std::string_view shape_name(const AnyVolume& volume);

}  // namespace pcl_bv
