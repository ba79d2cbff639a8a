// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sphere::intersect() for loops over many spheres.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "pcl_bv/volumes/geometry.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns Sphere(center, radius).intersect(origin, direction). All arguments must be finite, the radius at
/// least 0 and the direction not 0. The caller must hold a FloatEnvironment.
std::optional<RayInterval> intersect_sphere(const Eigen::Vector3d& center, double radius,
                                            const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);

}  // namespace detail
}  // namespace pcl_bv
