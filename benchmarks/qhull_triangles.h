// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace pcl_bv::bench {

using Triangle = std::array<std::int32_t, 3>;

/// The triangles of the convex hull as Qhull (Barber, Dobkin, Huhdanpaa 1996) finds them, up to rounding: a
/// peer of our own. None where it fails.
std::vector<Triangle> qhull_triangles(const std::vector<Eigen::Vector3d>& points);

}  // namespace pcl_bv::bench
