// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What the tests of the street share: sweeps of a few seeds, made once, and the points of a sweep as vectors.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "pcl_bv/synth/street.h"

namespace pcl_bv {
using namespace detail;

inline constexpr std::array<std::uint64_t, 3> street_seeds{1, 2, 3};

/// Six standard deviations: in a sweep of 128 000 rays, one more in four thousand sweeps.
inline constexpr double noise_bound = 6 * street_range_noise;

using Vector = std::array<double, 3>;

inline double dot(const Vector& a, const Vector& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

inline const StreetFrame& street_sweep(std::uint64_t seed) {
  static std::map<std::uint64_t, StreetFrame> sweeps;
  const auto [sweep, added] = sweeps.try_emplace(seed);
  if (added) sweep->second = make_street_frame({128'000, seed}, 0);
  return sweep->second;
}

inline Vector point_of(const SynthCloud& cloud, std::size_t i) {
  return {cloud.xyz[3 * i], cloud.xyz[3 * i + 1], cloud.xyz[3 * i + 2]};
}

inline double range_of(const SynthCloud& cloud, std::size_t i) {
  const Vector p = point_of(cloud, i);
  return std::sqrt(dot(p, p));
}

inline bool is_return(const SynthCloud& cloud, std::size_t i) {
  return range_of(cloud, i) > 0;
}

/// A return of neither ground nor object: a reflection.
inline bool is_false_return(const SynthCloud& cloud, std::size_t i) {
  return is_return(cloud, i) && cloud.object[i] == 0 && cloud.ground[i] == 0;
}

inline Vector beam_of(const SynthCloud& cloud, std::size_t i) {
  const std::size_t columns = cloud.size() / cloud.height;
  return street_beam(static_cast<double>(i / columns), i % columns, columns);
}

/// A point or direction in the axes of an object, a point relative to the center of its box.
inline Vector in_axes(const StreetObject& object, const Vector& v) {
  return {dot(object.axes[0], v), dot(object.axes[1], v), dot(object.axes[2], v)};
}

inline Vector from_center(const StreetObject& object, const Vector& p) {
  return in_axes(object, {p[0] - object.center[0], p[1] - object.center[1], p[2] - object.center[2]});
}

/// A corner of the box: bit a of `corner` says on which side of axis a.
inline Vector corner_of(const StreetObject& object, unsigned corner) {
  Vector p = object.center;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double half = (corner >> axis & 1u) != 0 ? object.half_extents[axis] : -object.half_extents[axis];
    for (std::size_t i = 0; i < 3; ++i)
      p[i] += half * object.axes[axis][i];
  }
  return p;
}

}  // namespace pcl_bv
