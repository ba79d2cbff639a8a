// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds of simple shapes whose bounding volumes are known.
//
// All shapes are centred at (1, 2, 3), so that code that ignores the centre gives a wrong result. Coordinates
// are computed in double and rounded to float. The same arguments give the same bits (on the same machine and
// libm). O(points).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pcl_bv/synth/synth_cloud.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

inline constexpr std::array<double, 3> shape_center{1, 2, 3};        ///< Centre of all shapes.
inline constexpr std::array<double, 3> box_half_extents{2, 1, 0.5};  ///< Half side lengths of make_box().

/// Returns points uniform on the surface of the sphere of radius 1.
SynthCloud make_sphere(std::size_t points, std::uint64_t seed);

/// Returns points uniform in the solid axis-aligned box of `box_half_extents`, including its faces.
SynthCloud make_box(std::size_t points, std::uint64_t seed);

/// Returns points whose coordinates are independent and normal with standard deviation 1.
SynthCloud make_gauss(std::size_t points, std::uint64_t seed);

/// Returns points on a bumpy closed surface. Each point is in a direction u from the centre, uniform on the
/// unit sphere, at the distance bumpy_radius(u, shape).
///
/// The number of points per unit area varies by a factor of about 4 between hollows and bumps.
SynthCloud make_surface(std::size_t points, std::uint64_t seed, double shape = 0);

/// Returns 1 + 0.16 sin(3 u_x + shape) + 0.12 sin(4 u_y + 2 shape) + 0.08 sin(6 u_z + 3 shape) for the unit
/// vector u = `direction`.
double bumpy_radius(const std::array<double, 3>& direction, double shape);

}  // namespace detail
}  // namespace pcl_bv
