// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/simple_polygon.h"

#include <algorithm>
#include <numeric>

#include "pcl_bv/volumes/planar_hull.h"

namespace pcl_bv::detail {
namespace {

using Corners = std::vector<Eigen::Vector2d>;

const Eigen::Vector2d& corner_at(const Corners& corners, std::size_t i) {
  return corners[i < corners.size() ? i : i - corners.size()];
}

bool is_before(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
}

bool is_counter_clockwise(const Corners& corners) {
  const auto first =
      static_cast<std::size_t>(std::min_element(corners.begin(), corners.end(), is_before) - corners.begin());
  return orientation(corner_at(corners, first + corners.size() - 1), corners[first],
                     corner_at(corners, first + 1)) > 0;
}

// Returns whether the edges that begin at the corners i and k have no point in common but a shared corner.
// Neighbouring edges are known not to be on one line.
bool are_apart(const Corners& corners, std::size_t i, std::size_t k) {
  const std::size_t count = corners.size();
  if ((i + 1) % count == k || (k + 1) % count == i) return true;
  return !segments_touch(corners[i], corner_at(corners, i + 1), corners[k], corner_at(corners, k + 1));
}

}  // namespace

bool segments_touch(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                    const Eigen::Vector2d& d) {
  const auto apart = [&](int axis) {
    return std::max(a[axis], b[axis]) < std::min(c[axis], d[axis]) ||
           std::max(c[axis], d[axis]) < std::min(a[axis], b[axis]);
  };
  if (apart(0) || apart(1)) return false;
  // If all four signs are 0, the segments are on one line, and their boxes have a point in common.
  return orientation(a, b, c) * orientation(a, b, d) <= 0 && orientation(c, d, a) * orientation(c, d, b) <= 0;
}

bool is_simple_polygon(const Corners& corners) {
  const std::size_t count = corners.size();
  if (count < 3 || !is_counter_clockwise(corners)) return false;
  for (std::size_t i = 0; i < count; ++i) {
    if (orientation(corners[i], corner_at(corners, i + 1), corner_at(corners, i + 2)) == 0) return false;
  }
  const auto low = [&](std::size_t i) { return std::min(corners[i].x(), corner_at(corners, i + 1).x()); };
  const auto high = [&](std::size_t i) { return std::max(corners[i].x(), corner_at(corners, i + 1).x()); };
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) { return low(i) < low(k); });
  // A line moves to the right. `active` has the edges that it meets.
  std::vector<std::size_t> active;
  for (const std::size_t edge : order) {
    active.erase(std::remove_if(active.begin(), active.end(),
                                [&](std::size_t other) { return high(other) < low(edge); }),
                 active.end());
    for (const std::size_t other : active) {
      if (!are_apart(corners, edge, other)) return false;
    }
    active.push_back(edge);
  }
  return true;
}

bool is_strictly_convex(const Corners& corners) {
  const std::vector<std::size_t> hull = planar_hull(corners);
  if (hull.size() != corners.size()) return false;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    if (hull[i] != (hull[0] + i) % hull.size()) return false;
  }
  return true;
}

// Even-odd rule: counts the edges to the right of the point. An edge has its lower end, but not its upper.
bool polygon_contains(const Corners& corners, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corner_at(corners, i + 1);
    if (p.y() < std::min(a.y(), b.y()) || p.y() > std::max(a.y(), b.y())) continue;
    const int side = orientation(a, b, p);
    if (side == 0 && p.x() >= std::min(a.x(), b.x()) && p.x() <= std::max(a.x(), b.x())) return true;
    if ((a.y() <= p.y()) != (b.y() <= p.y()) && (side > 0) == (b.y() > a.y())) inside = !inside;
  }
  return inside;
}

Corners without_straight_corners(const Corners& corners) {
  Corners result;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (orientation(corner_at(corners, i + corners.size() - 1), corners[i], corner_at(corners, i + 1)) != 0)
      result.push_back(corners[i]);
  }
  return result;
}

// A corner is an ear if the interior angle is below 180 degrees and no other corner is in its closed
// triangle. Every simple polygon with more than three corners has an ear, even if some corners are straight.
std::vector<std::array<std::size_t, 3>> triangles_of(const Corners& corners) {
  std::vector<std::size_t> left(corners.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  const auto is_ear = [&](std::size_t i, std::size_t j, std::size_t k) {
    const Eigen::Vector2d &a = corners[i], &b = corners[j], &c = corners[k];
    if (orientation(a, b, c) <= 0) return false;
    const Eigen::Vector2d low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    return std::none_of(left.begin(), left.end(), [&](std::size_t other) {
      const Eigen::Vector2d& p = corners[other];
      return (p.array() >= low.array()).all() && (p.array() <= high.array()).all() && other != i &&
             other != j && other != k && orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 &&
             orientation(c, a, p) >= 0;
    });
  };
  std::vector<std::array<std::size_t, 3>> triangles;
  std::size_t j = 0, misses = 0;
  while (left.size() >= 3 && misses < left.size()) {
    const std::size_t count = left.size();
    j %= count;
    const std::array<std::size_t, 3> triangle = {left[(j + count - 1) % count], left[j],
                                                 left[(j + 1) % count]};
    if (!is_ear(triangle[0], triangle[1], triangle[2])) {
      ++j;
      ++misses;
      continue;
    }
    triangles.push_back(triangle);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(j));
    misses = 0;
  }
  return triangles;
}

}  // namespace pcl_bv::detail
