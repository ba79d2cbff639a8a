// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hull/convex_hull.h"
#include "pcl_bv/numeric/coordinates.h"

namespace pcl_bv {

/// Grows a tetrahedron by the points outside, farthest first. A facet is seen by what is strictly above its
/// plane; so the facets that a point sees are connected, those in its own plane stay, and a point that sees
/// none of the new facets is inside (Barber, Dobkin, Huhdanpaa 1996, which holds for exact predicates as is).
class Quickhull {
 public:
  /// Corners: the positions of four points that are not in a plane. Keeps the points.
  Quickhull(const std::vector<Coordinates>& points, const std::array<std::int32_t, 4>& corners);

  /// Of positions of points.
  std::vector<Triangle> triangles() const;

  /// For each of triangles() a number that those in one plane share.
  std::vector<std::size_t> faces() const;

 private:
  struct Facet {
    Triangle corners;
    Triangle beside;                  // the facets behind the edges from corner k to corner k + 1
    std::vector<std::int32_t> above;  // points that see it and wait to be added
    std::int32_t visited = -1;        // the last point that asked whether it sees it
    bool removed = false;
  };

  struct Edge {
    std::int32_t from, to;
    std::int32_t kept;  // the facet on the other side, which stays
  };

  const Coordinates& at(std::int32_t i) const { return points_[static_cast<std::size_t>(i)]; }
  Facet& facet(std::int32_t i) { return facets_[static_cast<std::size_t>(i)]; }
  bool sees(std::int32_t point, const Facet& facet) const;
  bool in_plane(const Facet& facet, const Facet& other) const;
  std::int32_t farthest(const Facet& facet) const;
  void hand_out(const std::vector<std::int32_t>& points, std::size_t first);
  std::vector<Edge> remove_seen(std::int32_t point, std::int32_t start, std::vector<std::int32_t>& waiting);
  void add_farthest(std::int32_t start);

  const std::vector<Coordinates>& points_;
  std::vector<Facet> facets_;
  std::vector<std::int32_t> beginning_;  // by corner, the new facet whose edge begins there
};

}  // namespace pcl_bv
