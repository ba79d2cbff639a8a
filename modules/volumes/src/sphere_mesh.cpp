// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The mesh of a sphere is an icosahedron whose triangles are each split into four, twice.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/volumes/sphere.h"

namespace pcl_bv {
namespace {

Mesh icosahedron() {
  const double a = 1, b = (1 + std::sqrt(5.0)) / 2;
  Mesh mesh{{{-a, b, 0},
             {a, b, 0},
             {-a, -b, 0},
             {a, -b, 0},
             {0, -a, b},
             {0, a, b},
             {0, -a, -b},
             {0, a, -b},
             {b, 0, -a},
             {b, 0, a},
             {-b, 0, -a},
             {-b, 0, a}},
            {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
             {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
             {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (Eigen::Vector3d& v : mesh.vertices)
    v.normalize();
  return mesh;
}

Mesh split(const Mesh& mesh) {
  Mesh result{mesh.vertices, {}};
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t u, std::int32_t v) {
    const auto [entry, is_new] =
        middles.try_emplace(std::minmax(u, v), static_cast<std::int32_t>(result.vertices.size()));
    if (is_new) result.vertices.push_back((mesh.vertices[u] + mesh.vertices[v]).normalized());
    return entry->second;
  };
  for (const auto& face : mesh.faces) {
    const std::int32_t a = middle(face[0], face[1]), b = middle(face[1], face[2]),
                       c = middle(face[2], face[0]);
    result.faces.insert(result.faces.end(), {{face[0], a, c}, {face[1], b, a}, {face[2], c, b}, {a, b, c}});
  }
  return result;
}

}  // namespace

Mesh Sphere::mesh() const {
  const FloatEnvironment environment;
  if (empty()) return {};
  static const Mesh unit = split(split(icosahedron()));
  Mesh mesh = unit;
  for (Eigen::Vector3d& v : mesh.vertices)
    v = center_ + radius_ * v;
  return mesh;
}

}  // namespace pcl_bv
