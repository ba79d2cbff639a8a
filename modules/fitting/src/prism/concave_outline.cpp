// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// docs/numerics.md has the proof that no point is left outside.

#include "prism/concave_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <queue>
#include <tuple>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/volumes/planar_hull.h"
#include "pcl_bv/volumes/simple_polygon.h"
#include "prism/planar_grid.h"
#include "prism/widest_angle.h"

namespace pcl_bv::detail {
namespace {

// A triangle with counter-clockwise corners, and its box.
struct Triangle {
  Triangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
      : corners{a, b, c}, low(a.cwiseMin(b).cwiseMin(c)), high(a.cwiseMax(b).cwiseMax(c)) {}

  const Eigen::Vector2d& next(std::size_t i) const { return corners[i < 2 ? i + 1 : 0]; }

  bool contains(const Eigen::Vector2d& p) const {
    if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      if (orientation(corners[i], next(i), p) < 0) return false;
    }
    return true;
  }

  // Returns whether no point of a box, enlarged by `margin`, is in the triangle. False if this is not
  // certain.
  bool is_apart(const Eigen::Vector2d& box_low, const Eigen::Vector2d& box_high, double margin) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector2d edge = next(i) - corners[i];
      const Eigen::Vector2d leftmost(edge.y() < 0 ? box_high.x() : box_low.x(),
                                     edge.x() > 0 ? box_high.y() : box_low.y());
      const Eigen::Vector2d from = leftmost - corners[i];
      const double left = edge.x() * from.y(), right = edge.y() * from.x();
      const double rounding = 0x1p-48 * (std::abs(left) + std::abs(right)) +
                              4 * margin * (std::abs(edge.x()) + std::abs(edge.y())) + kSmallestNormal;
      if (left - right < -rounding) return true;
    }
    return false;
  }

  std::array<Eigen::Vector2d, 3> corners;
  Eigen::Vector2d low, high;
};

class OutlineRefiner {
 public:
  OutlineRefiner(const std::vector<Eigen::Vector2d>& hull, const std::vector<Eigen::Vector2d>& points,
                 double length)
      : grid_(points), squared_length_(length * length), is_corner_(grid_.points().size(), 0) {
    for (std::size_t i = 0; i < hull.size(); ++i) {
      edges_.push_back({hull[i], hull[(i + 1) % hull.size()], (i + 1) % hull.size()});
      is_corner_[grid_.find(hull[i])] = 1;
    }
    for (std::size_t i = 0; i < hull.size(); ++i)
      queue(i);
  }

  std::vector<Eigen::Vector2d> run() {
    while (!longest_.empty()) {
      const std::size_t i = std::get<3>(longest_.top());
      longest_.pop();
      if (const std::optional<std::uint32_t> p = point_for(edges_[i])) replace(i, *p);
    }
    std::vector<Eigen::Vector2d> outline;
    std::size_t i = 0;
    do {
      outline.push_back(edges_[i].a);
      i = edges_[i].next;
    } while (i != 0);
    return without_straight_corners(outline);
  }

 private:
  struct Edge {
    Eigen::Vector2d a, b;
    std::size_t next;  // the edge that begins at b
  };

  // By length, then by the ends, so that the order of equal lengths does not depend on that of the points.
  using Key = std::tuple<double, std::array<double, 2>, std::array<double, 2>, std::size_t>;

  void queue(std::size_t i) {
    const auto& [a, b, next] = edges_[i];
    const double squared = (b - a).squaredNorm();
    if (squared > squared_length_)
      longest_.push({squared, std::array{a.x(), a.y()}, std::array{b.x(), b.y()}, i});
  }

  void replace(std::size_t i, std::uint32_t position) {
    const Eigen::Vector2d p = grid_.points()[position];
    is_corner_[position] = 1;
    edges_.push_back({p, edges_[i].b, edges_[i].next});
    edges_[i].b = p;
    edges_[i].next = edges_.size() - 1;
    queue(i);
    queue(edges_.size() - 1);
  }

  // Returns a point by which an edge can be replaced, if there is one.
  std::optional<std::uint32_t> point_for(const Edge& edge) const {
    const std::optional<std::uint32_t> widest = widest_angle(grid_, is_corner_, edge.a, edge.b);
    if (!widest || is_on(edge, *widest)) return widest;
    const std::uint32_t p = apex_of_empty_triangle(edge, *widest);
    if (is_corner_[p] != 0) return std::nullopt;
    if (is_on(edge, p) || !meets_edge(edge, {edge.a, edge.b, grid_.points()[p]})) return p;
    return std::nullopt;
  }

  bool is_on(const Edge& edge, std::uint32_t i) const {
    return orientation(edge.a, edge.b, grid_.points()[i]) == 0;
  }

  // Returns a point of the closed triangle over the edge with this apex. The triangle over the edge with the
  // returned apex has no other point, unless the apex is a corner of the outline or on the edge.
  std::uint32_t apex_of_empty_triangle(const Edge& edge, std::uint32_t apex) const {
    Triangle triangle(edge.a, edge.b, grid_.points()[apex]);
    const Eigen::Vector2d box_low = triangle.low, box_high = triangle.high;
    grid_.visit_cells(
        box_low, box_high,
        [&](std::uint32_t begin, std::uint32_t end, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
          if (triangle.is_apart(low, high, grid_.rounding())) return false;
          for (std::uint32_t i = begin; i < end; ++i) {
            const Eigen::Vector2d& p = grid_.points()[i];
            const auto& corners = triangle.corners;
            if (!triangle.contains(p) || std::find(corners.begin(), corners.end(), p) != corners.end())
              continue;
            // The new triangle is inside the old one and does not have the old apex, so no point has to be
            // tested again.
            apex = i;
            if (is_corner_[i] != 0 || is_on(edge, i)) return true;
            triangle = Triangle(edge.a, edge.b, p);
          }
          return false;
        });
    return apex;
  }

  // Returns whether one of the two new edges would meet another edge. A neighbour of the replaced edge shares
  // a corner with one new edge, so the two are not compared. If they shared more, they would be on one line,
  // and either the other new edge would touch the neighbour, or this new edge the edge beyond the neighbour.
  bool meets_edge(const Edge& replaced, const Triangle& triangle) const {
    const auto& [a, b, p] = triangle.corners;
    for (const Edge& edge : edges_) {
      if ((edge.a.cwiseMin(edge.b).array() > triangle.high.array()).any() ||
          (edge.a.cwiseMax(edge.b).array() < triangle.low.array()).any() || &edge == &replaced)
        continue;
      const bool before = edge.b == a, after = edge.a == b;
      if (!before && segments_touch(a, p, edge.a, edge.b)) return true;
      if (!after && segments_touch(b, p, edge.a, edge.b)) return true;
    }
    return false;
  }

  PlanarGrid grid_;
  double squared_length_;
  std::vector<char> is_corner_;  // for each point of the grid
  std::vector<Edge> edges_;
  std::priority_queue<Key> longest_;
};

}  // namespace

std::vector<Eigen::Vector2d> concave_outline(const std::vector<Eigen::Vector2d>& hull,
                                             const std::vector<Eigen::Vector2d>& points, double length) {
  return OutlineRefiner(hull, points, length).run();
}

}  // namespace pcl_bv::detail
