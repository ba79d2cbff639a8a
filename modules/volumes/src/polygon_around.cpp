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

// The strip of an edge: the convex hull of the squares around both ends. It contains all points whose
// coordinates differ by at most the distance from those of a point of the edge.
class Strip {
 public:
  Strip(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double distance) {
    for (std::size_t k = 0; k < 4; ++k) {
      from_[k] = corner(a, k, distance);
      to_[k] = corner(b, k, distance);
    }
  }

  Eigen::Vector2d low() const { return from_[0].cwiseMin(to_[0]); }
  Eigen::Vector2d high() const { return from_[3].cwiseMax(to_[3]); }

  // Returns whether a line separates the strip's interior and the segment p q.
  bool is_apart(const Eigen::Vector2d& p, const Eigen::Vector2d& q) const {
    const Eigen::Vector2d from = low(), to = high();
    for (int axis = 0; axis < 2; ++axis) {
      if (std::max(p[axis], q[axis]) <= from[axis] || std::min(p[axis], q[axis]) >= to[axis]) return true;
    }
    if (is_on_side(p, q, 1) || is_on_side(p, q, -1)) return true;
    for (std::size_t k = 0; k < 4; ++k) {
      for (const int side : {1, -1}) {
        const bool beyond =
            side * orientation(from_[k], to_[k], p) <= 0 && side * orientation(from_[k], to_[k], q) <= 0;
        if (beyond && from_[k] != to_[k] && is_on_side(from_[k], to_[k], side)) return true;
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
  bool is_on_side(const Eigen::Vector2d& p, const Eigen::Vector2d& q, int side) const {
    const auto holds = [&](const Eigen::Vector2d& corner) { return side * orientation(p, q, corner) >= 0; };
    return std::all_of(from_.begin(), from_.end(), holds) && std::all_of(to_.begin(), to_.end(), holds);
  }

  std::array<Eigen::Vector2d, 4> from_, to_;
};

// The range of x of a strip or of an edge of the outer polygon.
struct Span {
  double low, high;
  std::size_t i;
  bool is_strip;
};

// Returns whether no edge of `outer` meets the interior of the strip of an edge of `inner`.
bool boundaries_are_apart(const Corners& outer, const Corners& inner, double distance) {
  const auto next = [](const Corners& corners, std::size_t i) -> const Eigen::Vector2d& {
    return corners[i + 1 < corners.size() ? i + 1 : 0];
  };
  std::vector<Strip> strips;
  std::vector<Span> spans;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    const Strip& strip = strips.emplace_back(inner[i], next(inner, i), distance);
    spans.push_back({strip.low().x(), strip.high().x(), i, true});
  }
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const double a = outer[i].x(), b = next(outer, i).x();
    spans.push_back({std::min(a, b), std::max(a, b), i, false});
  }
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.low < b.low; });
  // A line moves to the right. It meets the active edges and strips.
  std::array<std::vector<Span>, 2> active;
  for (const Span& span : spans) {
    std::vector<Span>& others = active[span.is_strip ? 0 : 1];
    others.erase(std::remove_if(others.begin(), others.end(),
                                [&](const Span& other) { return other.high < span.low; }),
                 others.end());
    for (const Span& other : others) {
      const std::size_t strip = span.is_strip ? span.i : other.i, edge = span.is_strip ? other.i : span.i;
      if (!strips[strip].is_apart(outer[edge], next(outer, edge))) return false;
    }
    active[span.is_strip ? 1 : 0].push_back(span);
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
