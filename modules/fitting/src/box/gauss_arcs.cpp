// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "box/gauss_arcs.h"

#include <algorithm>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {
GaussArcs::GaussArcs(const Silhouette& shape, SupportGraph& graph) {
  add_nodes(shape);
  arcs.reserve(shape.edges().size() * 5 / 4);
  for (const Silhouette::Edge& edge : shape.edges())
    add_arcs(edge, shape);
  measure(shape.vertices(), graph);
}

// Computes the normals of the facets. A facet whose area is only a rounding error lies in the plane of a
// neighbour, so it gets the normal of that neighbour. Neighbours at long edges are tried first.
void GaussArcs::add_nodes(const Silhouette& shape) {
  constexpr double kNoArea = 1e-14;
  nodes.reserve(shape.facets() * 5 / 4);
  for (std::size_t i = 0; i < shape.facets(); ++i) {
    const Eigen::Vector3d normal = shape.normal(i);
    const double length = norm3(normal);
    nodes.push_back(length > kNoArea ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::Zero());
  }
  const auto longer = [&](const Silhouette::Edge& a, const Silhouette::Edge& b) {
    const auto length = [&](const Silhouette::Edge& e) {
      return (shape.vertices()[e.from] - shape.vertices()[e.to]).squaredNorm();
    };
    return length(a) > length(b);
  };
  if (std::none_of(nodes.begin(), nodes.end(), [](const auto& n) { return n.isZero(0); })) return;
  std::vector<Silhouette::Edge> edges = shape.edges();
  std::stable_sort(edges.begin(), edges.end(), longer);
  for (bool filled = true; filled;) {
    filled = false;
    for (const Silhouette::Edge& e : edges) {
      const bool left = nodes[e.left].isZero(0), right = nodes[e.right].isZero(0);
      if (left == right) continue;
      nodes[left ? e.left : e.right] = nodes[left ? e.right : e.left];
      filled = true;
      break;
    }
  }
}

// The ends of a shorter edge than kNoLength are one point up to rounding, and squares of its length could
// underflow. A hull with one vertex instead of the two has no such arc.
void GaussArcs::add_arcs(const Silhouette::Edge& edge, const Silhouette& shape) {
  constexpr double kNoLength = 0x1p-400;
  const Eigen::Vector3d along = shape.vertices()[edge.to] - shape.vertices()[edge.from];
  if (nodes[edge.left] == nodes[edge.right] || along.cwiseAbs().maxCoeff() < kNoLength) return;
  add_cut(edge.left, edge.right, along, edge.from, 0);
}

void GaussArcs::add_cut(std::int32_t from, std::int32_t to, const Eigen::Vector3d& along, std::int32_t vertex,
                        int depth) {
  const Eigen::Vector3d a = nodes[from], b = nodes[to];
  const Eigen::Vector3d middle = cross3(Eigen::Vector3d(b - a), along);
  if (dot3(a, b) >= 0.5 || depth == 3 || middle.isZero(0)) {
    arcs.push_back({from, to, vertex, 0, 0});
    return;
  }
  const auto cut = static_cast<std::int32_t>(nodes.size());
  nodes.push_back(unit3(middle));
  add_cut(from, cut, along, vertex, depth + 1);
  add_cut(cut, to, along, vertex, depth + 1);
}

// Computes the lower bounds of the widths. For one fixed opposite vertex, the width along the unit normals of
// an arc is a cosine function of the angle. Where this function is positive, it is concave, so its minimum is
// at an end of the arc.
void GaussArcs::measure(const std::vector<Eigen::Vector3d>& vertices, SupportGraph& graph) {
  std::vector<std::int32_t> farthest;
  farthest.reserve(nodes.size());
  for (const Eigen::Vector3d& n : nodes)
    farthest.push_back(graph.support_vertices(n).low);
  width = kInfinity;
  for (Arc& arc : arcs) {
    const auto over = [&](std::int32_t vertex) {
      const Eigen::Vector3d across = vertices[arc.vertex] - vertices[vertex];
      return std::min(dot3(across, nodes[arc.from]), dot3(across, nodes[arc.to]));
    };
    arc.width = std::max({0.0, over(farthest[arc.from]), over(farthest[arc.to])});
    width = std::min(width, arc.width);
    arc.opposite = graph.climb(farthest[arc.from], -(nodes[arc.from] + nodes[arc.to]));
  }
}

}  // namespace pcl_bv::detail
