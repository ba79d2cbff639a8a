// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "box/silhouette.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>
#include <utility>

#include "box/rectangle.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {
namespace {

// An edge as a side of one of its two facets.
struct Side {
  std::int32_t low, high;
  bool falls;  // whether the side runs from the higher vertex index to the lower
  std::int32_t facet;

  auto key() const { return std::tie(low, high, falls); }
};

std::vector<Side> sides_of(const std::vector<Triangle>& triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t from = triangles[t][k], to = triangles[t][(k + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), to < from, static_cast<std::int32_t>(t)});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.key() < b.key(); });
  return sides;
}

// Returns whether b is to the right of the line from a to c by more than rounding errors, for a hull with an
// extent from 1 to 2. If facets or edges are parallel to the view, several corners are in a line or at the
// same position. Such corners are dropped, because rotating calipers would stop at them too early.
bool sticks_out(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  constexpr double kRounding = 1e-13;
  const Eigen::Vector2d along = c - a, to = b - a;
  const double cross = to.x() * along.y() - to.y() * along.x();
  return cross > 0 && cross * cross > kRounding * kRounding * along.squaredNorm();
}

}  // namespace

Silhouette::Silhouette(std::vector<Eigen::Vector3d> vertices, const std::vector<Triangle>& triangles)
    : vertices_(std::move(vertices)) {
  const auto at = [&](std::int32_t i) { return vertices_[static_cast<std::size_t>(i)]; };
  for (std::vector<double>& coordinate : normals_)
    coordinate.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    const Eigen::Vector3d normal = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
    for (std::size_t k = 0; k < 3; ++k)
      normals_[k].push_back(normal[static_cast<Eigen::Index>(k)]);
  }
  const std::vector<Side> sides = sides_of(triangles);
  edges_.reserve(sides.size() / 2);
  for (std::size_t i = 0; i < sides.size(); i += 2)
    edges_.push_back({sides[i].low, sides[i].high, sides[i].facet, sides[i + 1].facet});
}

void Silhouette::find_rim(const Eigen::Vector3d& towards, Projection& projection) const {
  const double x = towards.x(), y = towards.y(), z = towards.z();
  const double *nx = normals_[0].data(), *ny = normals_[1].data(), *nz = normals_[2].data();
  projection.facing.resize(normals_[0].size());
  double* const facing = projection.facing.data();
  for (std::size_t t = 0; t < projection.facing.size(); ++t)
    facing[t] = (nx[t] * x + ny[t] * y) + nz[t] * z;
  projection.rim.resize(edges_.size());
  std::size_t count = 0;
  for (const Edge& edge : edges_) {  // The loop has no branches, because they would be unpredictable.
    const bool left = facing[edge.left] > 0, right = facing[edge.right] > 0;
    const std::int32_t turned = (edge.from ^ edge.to) & (static_cast<std::int32_t>(left) - 1);
    projection.rim[count] = {edge.from ^ turned, edge.to ^ turned};
    count += left != right;
  }
  projection.rim.resize(count);
  projection.next.resize(vertices_.size());
  for (const auto& [from, to] : projection.rim)
    projection.next[static_cast<std::size_t>(from)] = to;
}

bool Silhouette::follow_rim(const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                            Projection& projection) const {
  std::vector<Eigen::Vector2d>& corners = projection.corners;
  corners.clear();
  if (projection.rim.empty()) return false;
  const auto drop_flat_before = [&](const Eigen::Vector2d& next) {
    while (corners.size() >= 2 && !sticks_out(corners[corners.size() - 2], corners.back(), next))
      corners.pop_back();
  };
  const std::int32_t first = projection.rim.front().from;
  std::int32_t at = first;
  std::size_t steps = 0;
  do {
    const Eigen::Vector3d& p = vertices_[static_cast<std::size_t>(at)];
    const Eigen::Vector2d corner(dot3(u, p), dot3(v, p));
    drop_flat_before(corner);
    corners.push_back(corner);
    at = projection.next[static_cast<std::size_t>(at)];
  } while (++steps < projection.rim.size() && at != first);
  drop_flat_before(corners.front());
  return at == first && steps == projection.rim.size() && corners.size() > 2;
}

const std::vector<Eigen::Vector2d>& Silhouette::project(const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                                                        Projection& projection) const {
  find_rim(u.cross(v), projection);
  if (follow_rim(u, v, projection)) return projection.corners;
  // Rounding can flip the orientation of thin facets. Then the rim is not a single closed chain of edges, and
  // the corners are found among all vertices.
  projection.corners.clear();
  for (const Eigen::Vector3d& p : vertices_)
    projection.corners.emplace_back(dot3(u, p), dot3(v, p));
  projection.corners.resize(to_convex_chain(projection.corners.data(), projection.corners.size()));
  return projection.corners;
}

}  // namespace pcl_bv::detail
