// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Moves the edges of a simple polygon outward in rounded arithmetic. Exact predicates then decide whether the
// result has the property that polygon_around() promises. docs/numerics.md has the proof.

#include <algorithm>
#include <array>
#include <cmath>

#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/volumes/planar_hull.h"
#include "pcl_bv/volumes/simple_polygon.h"

namespace pcl_bv::detail {
namespace {

using Corners = std::vector<Eigen::Vector2d>;

// Returns the outward unit normal of the edge from a to b.
Eigen::Vector2d outward_normal(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return Eigen::Vector2d(b.y() - a.y(), a.x() - b.x()).stableNormalized();
}

// Returns the intersections of the edges after each has moved outward by `distance`. Returns nothing if an
// angle is so small, inside or outside, that its corner would move by more than 2^10 distances.
std::optional<Corners> moved_corners(const Corners& corners, double distance) {
  const std::size_t count = corners.size();
  Corners moved;
  Eigen::Vector2d before = outward_normal(corners[count - 1], corners[0]);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d after = outward_normal(corners[i], corners[i + 1 < count ? i + 1 : 0]);
    const double sum = 1 + (before.x() * after.x() + before.y() * after.y());
    if (!(sum > 0x1p-19)) return std::nullopt;
    moved.emplace_back(corners[i] + distance / sum * (before + after));
    before = after;
  }
  return moved;
}

// The corners of the squares around both ends of an edge. Their convex hull contains all points whose
// coordinates differ by at most the distance from those of a point of the edge.
class WideEdge {
 public:
  WideEdge(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double distance) {
    for (std::size_t k = 0; k < 4; ++k) {
      from_[k] = corner(a, k, distance);
      to_[k] = corner(b, k, distance);
    }
  }

  Eigen::Vector2d low() const { return from_[0].cwiseMin(to_[0]); }
  Eigen::Vector2d high() const { return from_[3].cwiseMax(to_[3]); }

  // Returns whether a line separates the segment from p to q from the inside of the hull.
  bool is_apart(const Eigen::Vector2d& p, const Eigen::Vector2d& q) const {
    const Eigen::Vector2d least = low(), most = high();
    for (int axis = 0; axis < 2; ++axis) {
      if (std::max(p[axis], q[axis]) <= least[axis] || std::min(p[axis], q[axis]) >= most[axis]) return true;
    }
    if (is_beside(p, q, 1) || is_beside(p, q, -1)) return true;
    for (std::size_t k = 0; k < 4; ++k) {
      for (const int side : {1, -1}) {
        const bool beyond =
            side * orientation(from_[k], to_[k], p) <= 0 && side * orientation(from_[k], to_[k], q) <= 0;
        if (beyond && from_[k] != to_[k] && is_beside(from_[k], to_[k], side)) return true;
      }
    }
    return false;
  }

 private:
  static Eigen::Vector2d corner(const Eigen::Vector2d& p, std::size_t k, double distance) {
    const auto coordinate = [&](int axis, bool positive) {
      return positive ? add_up(p[axis], distance) : -add_up(-p[axis], distance);
    };
    return {coordinate(0, (k & 1) != 0), coordinate(1, (k & 2) != 0)};
  }

  // Returns whether all corners are on one side of the line from p to q: the left if `side` is 1.
  bool is_beside(const Eigen::Vector2d& p, const Eigen::Vector2d& q, int side) const {
    const auto beside = [&](const Eigen::Vector2d& at) { return side * orientation(p, q, at) >= 0; };
    return std::all_of(from_.begin(), from_.end(), beside) && std::all_of(to_.begin(), to_.end(), beside);
  }

  std::array<Eigen::Vector2d, 4> from_, to_;
};

// Returns whether no edge of `outer` meets the inside of a wide edge of `inner`.
bool boundaries_are_apart(const Corners& outer, const Corners& inner, double distance) {
  struct Edge {
    double low, high;
    Eigen::Vector2d a, b;
  };
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const Eigen::Vector2d &a = outer[i], &b = outer[i + 1 < outer.size() ? i + 1 : 0];
    edges.push_back({std::min(a.x(), b.x()), std::max(a.x(), b.x()), a, b});
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& e, const Edge& f) { return e.low < f.low; });
  for (std::size_t i = 0; i < inner.size(); ++i) {
    const WideEdge wide(inner[i], inner[i + 1 < inner.size() ? i + 1 : 0], distance);
    const double low = wide.low().x(), high = wide.high().x();
    for (const Edge& edge : edges) {
      if (edge.low > high) break;
      if (edge.high >= low && !wide.is_apart(edge.a, edge.b)) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<Corners> polygon_around(const Corners& corners, double distance) {
  if (distance == 0) return corners;
  double farthest = 0;
  for (const Eigen::Vector2d& corner : corners)
    farthest = std::max(farthest, corner.cwiseAbs().maxCoeff());
  // The hull of two squares extends from its edge by at most sqrt(2) times the distance. The rest covers the
  // rounding of the moved corners and of the squares.
  std::optional<Corners> outer = moved_corners(corners, 4 * distance + 0x1p-50 * farthest);
  if (!outer) return std::nullopt;
  *outer = without_straight_corners(*outer);
  for (Eigen::Vector2d& corner : *outer)
    corner.array() += 0.0;
  if (is_simple_polygon(*outer) && polygon_contains(*outer, corners.front()) &&
      boundaries_are_apart(*outer, corners, distance))
    return outer;
  return std::nullopt;
}

}  // namespace pcl_bv::detail
