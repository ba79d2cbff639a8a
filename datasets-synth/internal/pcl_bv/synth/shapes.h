// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds of simple shapes whose bounding volumes are known.
//
// All are centred at (1, 2, 3), so that nothing that forgets an offset gives the right answer. Coordinates
// are computed in double and rounded to float. Same arguments, same bits (same machine and libm). O(points).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pcl_bv/synth/synth_cloud.h"

namespace [[gnu::visibility("default")]] pcl_bv {

inline constexpr std::array<double, 3> shape_center{1, 2, 3};
inline constexpr std::array<double, 3> box_half_extents{2, 1, 0.5};

/// Uniform on the surface of the sphere of radius 1 (by Archimedes: z is uniform on a sphere).
SynthCloud make_sphere(std::size_t points, std::uint64_t seed);

/// Uniform in the solid axis-aligned box of `box_half_extents`, faces included.
SynthCloud make_box(std::size_t points, std::uint64_t seed);

/// Normal in each coordinate, independent, standard deviation 1.
SynthCloud make_gauss(std::size_t points, std::uint64_t seed);

/// On the bumpy closed surface at distance bumpy_radius(u, shape) from the centre, u uniform on the unit
/// sphere.
///
/// Per unit of area the density varies, since bumps stretch it: by about 4 between hollow and hill.
SynthCloud make_surface(std::size_t points, std::uint64_t seed, double shape = 0);

/// 1 + 0.16 sin(3 u_x + shape) + 0.12 sin(4 u_y + 2 shape) + 0.08 sin(6 u_z + 3 shape), for a unit vector u.
double bumpy_radius(const std::array<double, 3>& direction, double shape);

}  // namespace pcl_bv
