// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What every mesh of a solid is.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <set>
#include <utility>

#include "pcl_bv/volumes/geometry.h"

namespace pcl_bv::testing {

/// Every edge is met once in each direction, and V - E + F = 2.
inline void expect_closed(const Mesh& mesh) {
  std::multiset<std::pair<int, int>> edges;
  for (const auto& f : mesh.faces) {
    for (std::size_t i = 0; i < f.size(); ++i)
      edges.emplace(f[i], f[(i + 1) % f.size()]);
  }
  for (const auto& [a, b] : edges) {
    EXPECT_EQ(edges.count({a, b}), 1u);
    EXPECT_EQ(edges.count({b, a}), 1u);
  }
  EXPECT_EQ(mesh.vertices.size() + mesh.faces.size(), edges.size() / 2 + 2);
}

}  // namespace pcl_bv::testing
