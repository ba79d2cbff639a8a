// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The Gauss map of a hull. The outward normals of the planes that touch the hull along an edge form an arc,
// from the normal of one facet at the edge to the normal of the other.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "box/silhouette.h"
#include "box/support_graph.h"

namespace pcl_bv::detail {

/// The arcs of all edges of a hull, and lower bounds of the hull's width.
struct GaussArcs {
  /// The arc of an edge. An arc of more than 60 degrees is divided into several elements of `arcs`.
  struct Arc {
    std::int32_t from, to;  ///< Indices into `nodes` of the normals at the two ends.
    std::int32_t vertex;    ///< A vertex of the edge that the arc belongs to.
    std::int32_t opposite;  ///< A vertex with the minimum projection on the arc's middle normal.
    double width;           ///< Lower bound of the hull's width along any normal of the arc.
  };

  /// The unit normals of the facets, then the unit normals at which arcs are divided.
  std::vector<Eigen::Vector3d> nodes;
  std::vector<Arc> arcs;

  /// Lower bound of the hull's width along any direction. It is the minimum over the arcs, because the
  /// direction in which a polytope is thinnest is perpendicular to a facet or to two edges.
  double width = 0;

  GaussArcs(const Silhouette& shape, SupportGraph& graph);

 private:
  void add_nodes(const Silhouette& shape);
  void add_arcs(const Silhouette::Edge& edge, const Silhouette& shape);
  void add_cut(std::int32_t from, std::int32_t to, const Eigen::Vector3d& along, std::int32_t vertex,
               int depth);
  void measure(const std::vector<Eigen::Vector3d>& vertices, SupportGraph& graph);
};

}  // namespace pcl_bv::detail
