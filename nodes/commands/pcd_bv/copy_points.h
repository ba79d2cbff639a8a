// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Copying of coordinates.
#pragma once

#include <cstddef>
#include <cstring>

#include "pcl_bv/points/point_view.h"

namespace pcl_bv::detail {

/// Copies the coordinates of the points to `to`, without gaps and as numbers of type `scalar`. The points
/// must be in memory. Only float32 points can be copied as float32.
inline void copy_points(const PointView& points, ScalarType scalar, std::byte* to) {
  const auto copy = [&](auto example, const auto& load) {
    decltype(example) xyz[3];
    for (std::size_t i = 0; i < points.count; ++i, to += sizeof xyz) {
      load(i, xyz);
      std::memcpy(to, xyz, sizeof xyz);
    }
  };
  if (scalar == ScalarType::float32) {
    copy(float{}, [&](std::size_t i, float(&xyz)[3]) { load_point(points, i, xyz); });
  } else {
    copy(double{}, [&](std::size_t i, double(&xyz)[3]) {
      const Coordinates p = load_point(points, i);
      xyz[0] = p.x;
      xyz[1] = p.y;
      xyz[2] = p.z;
    });
  }
}

}  // namespace pcl_bv::detail
