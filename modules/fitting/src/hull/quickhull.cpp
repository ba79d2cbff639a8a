// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "hull/quickhull.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "local_frame.h"

namespace pcl_bv::detail {

Quickhull::Quickhull(const std::vector<Coordinates>& points, const std::array<std::int32_t, 4>& corners)
    : points_(points), facet_from_(points.size()) {
  std::array<std::int32_t, 4> c = corners;
  // The fourth corner must be below the plane of the first three.
  if (side_of_plane(at(c[0]), at(c[1]), at(c[2]), at(c[3])) > 0) std::swap(c[1], c[2]);
  facets_ = {{{c[0], c[1], c[2]}, {1, 2, 3}, {}},
             {{c[1], c[0], c[3]}, {0, 3, 2}, {}},
             {{c[2], c[1], c[3]}, {0, 1, 3}, {}},
             {{c[0], c[2], c[3]}, {0, 2, 1}, {}}};
  std::vector<std::int32_t> all(points_.size());
  std::iota(all.begin(), all.end(), 0);
  assign_points(all, 0);
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    if (!facets_[f].removed && !facets_[f].above.empty()) add_farthest(static_cast<std::int32_t>(f));
  }
}

std::vector<Triangle> Quickhull::triangles() const {
  std::vector<Triangle> found;
  for (const Facet& facet : facets_) {
    if (!facet.removed) found.push_back(facet.corners);
  }
  return found;
}

// Facets in one plane are connected, so a search over neighbours finds them.
std::vector<std::size_t> Quickhull::faces() const {
  std::vector<std::size_t> face(facets_.size());
  std::iota(face.begin(), face.end(), std::size_t{0});
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    if (facets_[f].removed || face[f] != f) continue;
    std::vector<std::size_t> stack{f};
    while (!stack.empty()) {
      const Facet& facet = facets_[stack.back()];
      stack.pop_back();
      for (const std::int32_t neighbour : facet.neighbours) {
        const auto g = static_cast<std::size_t>(neighbour);
        if (face[g] == f || !in_plane(facet, facets_[g])) continue;
        face[g] = f;
        stack.push_back(g);
      }
    }
  }
  std::vector<std::size_t> left;
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    if (!facets_[f].removed) left.push_back(face[f]);
  }
  return left;
}

bool Quickhull::sees(std::int32_t point, const Facet& facet) const {
  return side_of_plane(at(facet.corners[0]), at(facet.corners[1]), at(facet.corners[2]), at(point)) > 0;
}

bool Quickhull::in_plane(const Facet& facet, const Facet& other) const {
  const std::int32_t a = facet.corners[0], b = facet.corners[1], c = facet.corners[2];
  return std::all_of(other.corners.begin(), other.corners.end(), [&](std::int32_t i) {
    return i == a || i == b || i == c || side_of_plane(at(a), at(b), at(c), at(i)) == 0;
  });
}

// Assigns each point to the first facet that it sees, among the facets with numbers of at least `first`.
// Points that see none of these facets are inside.
void Quickhull::assign_points(const std::vector<std::int32_t>& points, std::size_t first) {
  for (const std::int32_t point : points) {
    const auto seen = std::find_if(facets_.begin() + static_cast<std::ptrdiff_t>(first), facets_.end(),
                                   [&](const Facet& facet) { return sees(point, facet); });
    if (seen != facets_.end()) seen->above.push_back(point);
  }
}

// Returns the point farthest above the facet. Of equally far points it returns the first, because only the
// first of several equal points may become a vertex.
std::int32_t Quickhull::farthest(const Facet& facet) const {
  const Eigen::Vector3d a = vector(at(facet.corners[0]));
  const Eigen::Vector3d normal = (vector(at(facet.corners[1])) - a).cross(vector(at(facet.corners[2])) - a);
  const auto height = [&](std::int32_t i) { return normal.dot(vector(at(i)) - a); };
  std::int32_t best = facet.above.front();
  double greatest = height(best);
  for (const std::int32_t i : facet.above) {
    const double h = height(i);
    if (h > greatest || (h == greatest && i < best)) {
      greatest = h;
      best = i;
    }
  }
  return best;
}

// Removes the facets that the point sees. `start` is one of them. Returns the horizon, which consists of the
// edges around these facets. Appends the points above these facets to `waiting`.
std::vector<Quickhull::Edge> Quickhull::remove_seen(std::int32_t point, std::int32_t start,
                                                    std::vector<std::int32_t>& waiting) {
  std::vector<Edge> horizon_edges;
  std::vector<std::int32_t> stack{start};
  facet(start).removed = true;
  while (!stack.empty()) {
    Facet& seen = facet(stack.back());
    stack.pop_back();
    waiting.insert(waiting.end(), seen.above.begin(), seen.above.end());
    std::vector<std::int32_t>().swap(seen.above);
    for (std::size_t k = 0; k < 3; ++k) {
      Facet& other = facet(seen.neighbours[k]);
      if (other.removed) continue;
      if (other.visited != point && sees(point, other)) {
        other.removed = true;
        stack.push_back(seen.neighbours[k]);
        continue;
      }
      other.visited = point;  // so that sees() is called only once for this facet
      horizon_edges.push_back({seen.corners[k], seen.corners[(k + 1) % 3], seen.neighbours[k]});
    }
  }
  return horizon_edges;
}

void Quickhull::add_farthest(std::int32_t start) {
  const std::int32_t point = farthest(facet(start));
  std::vector<std::int32_t> waiting;
  const std::vector<Edge> horizon_edges = remove_seen(point, start, waiting);
  const std::size_t first = facets_.size();
  for (std::size_t i = 0; i < horizon_edges.size(); ++i)
    facet_from_[static_cast<std::size_t>(horizon_edges[i].from)] = static_cast<std::int32_t>(first + i);
  for (const Edge& edge : horizon_edges) {
    const auto number = static_cast<std::int32_t>(facets_.size());
    facets_.push_back({{edge.from, edge.to, point}, {edge.kept, -1, -1}, {}});
    Facet& kept = facet(edge.kept);
    for (std::size_t k = 0; k < 3; ++k)
      if (kept.corners[k] == edge.to) kept.neighbours[k] = number;
  }
  for (std::size_t i = 0; i < horizon_edges.size(); ++i) {
    const std::int32_t next = facet_from_[static_cast<std::size_t>(horizon_edges[i].to)];
    facets_[first + i].neighbours[1] = next;
    facet(next).neighbours[2] = static_cast<std::int32_t>(first + i);
  }
  assign_points(waiting, first);
}

}  // namespace pcl_bv::detail
