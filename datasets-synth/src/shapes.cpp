// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The generators of the simple shapes.
#include "pcl_bv/synth/shapes.h"

#include <cmath>
#include <numbers>

#include "pcl_bv/synth/random.h"

namespace pcl_bv::detail {
namespace {

using Offset = std::array<double, 3>;

/// Returns a unit vector uniform on the sphere. Its z is uniform in [-1, 1] (Archimedes).
Offset uniform_direction(SplitMix64& random) {
  const double z = random.uniform(-1, 1);
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  const double radius = std::sqrt(1 - z * z);
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// Returns `points` points. draw(random) gives the offset of each point from the centre.
template <typename Draw>
SynthCloud draw_points(std::size_t points, std::uint64_t seed, Draw draw) {
  SynthCloud cloud;
  cloud.xyz.reserve(3 * points);
  SplitMix64 random({seed});
  for (std::size_t i = 0; i < points; ++i) {
    const Offset offset = draw(random);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cloud.xyz.push_back(static_cast<float>(shape_center[axis] + offset[axis]));
    }
  }
  return cloud;
}

}  // namespace

SynthCloud make_sphere(std::size_t points, std::uint64_t seed) {
  return draw_points(points, seed, uniform_direction);
}

SynthCloud make_box(std::size_t points, std::uint64_t seed) {
  return draw_points(points, seed, [](SplitMix64& random) {
    Offset offset;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      offset[axis] = random.uniform(-box_half_extents[axis], box_half_extents[axis]);
    }
    return offset;
  });
}

SynthCloud make_gauss(std::size_t points, std::uint64_t seed) {
  return draw_points(points, seed, [](SplitMix64& random) {
    Offset offset;
    for (double& coordinate : offset)
      coordinate = random.normal();
    return offset;
  });
}

SynthCloud make_surface(std::size_t points, std::uint64_t seed, double shape) {
  return draw_points(points, seed, [shape](SplitMix64& random) {
    const Offset direction = uniform_direction(random);
    const double radius = bumpy_radius(direction, shape);
    return Offset{radius * direction[0], radius * direction[1], radius * direction[2]};
  });
}

double bumpy_radius(const std::array<double, 3>& direction, double shape) {
  return 1 + 0.16 * std::sin(3 * direction[0] + shape) + 0.12 * std::sin(4 * direction[1] + 2 * shape) +
         0.08 * std::sin(6 * direction[2] + 3 * shape);
}

}  // namespace pcl_bv::detail
