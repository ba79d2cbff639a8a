// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The Gauss map of a hull: the outward normals of planes that touch it along an edge are an arc from the
// normal of one facet at the edge to that of the other.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "box/silhouette.h"
#include "box/support_graph.h"

namespace pcl_bv {

struct GaussArcs {
  /// Long arcs are cut: the ends of none are farther apart than 60 degrees.
  struct Arc {
    std::int32_t from, to;  ///< Nodes.
    std::int32_t vertex;    ///< On the edge.
    std::int32_t opposite;  ///< A vertex that is farthest back along the middle of the arc.
    double width;           ///< A lower bound of the hull's width along any normal of the arc.
  };

  /// Unit normals: of the facets, then of the cuts.
  std::vector<Eigen::Vector3d> nodes;
  std::vector<Arc> arcs;

  /// A lower bound of the hull's width along any direction: a polytope is thinnest between two edges, or a
  /// facet and a vertex.
  double width = 0;

  GaussArcs(const Silhouette& shape, SupportGraph& graph);

 private:
  void add_nodes(const Silhouette& shape);
  void add_arcs(const Silhouette::Edge& edge, const Silhouette& shape);
  void add_cut(std::int32_t from, std::int32_t to, const Eigen::Vector3d& along, std::int32_t vertex,
               int depth);
  void measure(const std::vector<Eigen::Vector3d>& vertices, SupportGraph& graph);
};

}  // namespace pcl_bv
