// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Quickhull in exact arithmetic.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hull/convex_hull.h"
#include "pcl_bv/numeric/coordinates.h"

namespace pcl_bv::detail {

/// Begins with a tetrahedron and adds the points outside, the farthest first (Barber, Dobkin, Huhdanpaa
/// 1996). A point sees a facet if it is strictly above the plane of the facet. Three facts follow from this
/// definition. The facets that a point sees are connected. A facet whose plane contains the point remains. A
/// point that sees none of the new facets is inside. With exact predicates, the proof of the authors holds
/// unchanged.
class Quickhull {
 public:
  /// Computes the hull. `corners` are the positions of four points that are not in a plane. Stores a
  /// reference to `points`.
  Quickhull(const std::vector<Coordinates>& points, const std::array<std::int32_t, 4>& corners);

  /// Returns the facets. The corners are positions in `points`.
  std::vector<Triangle> triangles() const;

  /// Returns for each triangle, in the order of triangles(), the number of its face. Triangles in one plane
  /// have the same number.
  std::vector<std::size_t> faces() const;

 private:
  struct Facet {
    Triangle corners;
    Triangle neighbours;              // the facets at the edges from corner k to corner k + 1
    std::vector<std::int32_t> above;  // points that see the facet and are still to be added
    std::int32_t visited = -1;        // the last point that was tested and does not see the facet
    bool removed = false;
  };

  struct Edge {
    std::int32_t from, to;
    std::int32_t kept;  // the facet on the other side, which remains
  };

  const Coordinates& at(std::int32_t i) const { return points_[static_cast<std::size_t>(i)]; }
  Facet& facet(std::int32_t i) { return facets_[static_cast<std::size_t>(i)]; }
  bool sees(std::int32_t point, const Facet& facet) const;
  bool in_plane(const Facet& facet, const Facet& other) const;
  std::int32_t farthest(const Facet& facet) const;
  void assign_points(const std::vector<std::int32_t>& points, std::size_t first);
  std::vector<Edge> remove_seen(std::int32_t point, std::int32_t start, std::vector<std::int32_t>& waiting);
  void add_farthest(std::int32_t start);

  const std::vector<Coordinates>& points_;
  std::vector<Facet> facets_;
  std::vector<std::int32_t> facet_from_;  // per point, the new facet whose horizon edge begins at the point
};

}  // namespace pcl_bv::detail
