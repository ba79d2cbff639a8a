// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ring_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pcl_bv::detail {

Mesh ring_mesh(const std::vector<Ring>& rings, const Triad& triad, int sides) {
  Mesh mesh;
  for (const Ring& ring : rings) {
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      mesh.vertices.push_back(ring.center +
                              ring.radius * (std::cos(angle) * triad.u + std::sin(angle) * triad.v));
    }
  }
  for (int ring = 0; ring + 1 < static_cast<int>(rings.size()); ++ring) {
    for (int i = 0; i < sides; ++i) {
      const int a = ring * sides + i, b = ring * sides + (i + 1) % sides;
      mesh.faces.push_back({a, b, b + sides, a + sides});
    }
  }
  std::vector<std::int32_t> bottom, top;
  for (int i = 0; i < sides; ++i) {
    bottom.push_back(sides - 1 - i);
    top.push_back(static_cast<int>(mesh.vertices.size()) - sides + i);
  }
  mesh.faces.push_back(bottom);
  mesh.faces.push_back(top);
  return mesh;
}

}  // namespace pcl_bv::detail
