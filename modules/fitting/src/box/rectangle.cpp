// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "box/rectangle.h"

#include <algorithm>
#include <cmath>

#include "pcl_bv/numeric/constants.h"

namespace pcl_bv::detail {
namespace {

double dot(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.x() + a.y() * b.y();
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Returns whether the path from a through b to c turns left.
bool turns_left(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return cross(b - a, c - a) > 0;
}

}  // namespace

// The leftmost, lowest, rightmost and highest points are corners. Points inside the quadrilateral of these
// four are dropped. The other points are divided into four runs, each between two successive corners.
std::size_t to_convex_chain(Eigen::Vector2d* points, std::size_t count) {
  if (count < 2) return count;
  Eigen::Vector2d* const end = points + count;
  const auto before = [](const auto& a, const auto& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  };
  const auto below = [](const auto& a, const auto& b) {
    return a.y() != b.y() ? a.y() < b.y() : a.x() > b.x();
  };
  const auto [left, right] = std::minmax_element(points, end, before);
  const auto [low, high] = std::minmax_element(points, end, below);
  const Eigen::Vector2d corner[5] = {*left, *low, *right, *high, *left};
  Eigen::Vector2d* begin[5];
  begin[4] = end;
  for (int run = 3; run >= 0; --run) {
    const auto beyond = [&](const auto& p) {
      return cross(corner[run + 1] - corner[run], p - corner[run]) < 0 &&
             std::find(corner, corner + 4, p) == corner + 4;
    };
    begin[run] = std::partition(points, begin[run + 1], [&](const auto& p) { return !beyond(p); });
  }
  // The loop below writes the result to the front of `points` while it reads the runs. The points before
  // begin[0] include the four corners, so the result never overwrites a point that is still to be read.
  std::size_t kept = 0;
  const auto add = [&](const Eigen::Vector2d& next, std::size_t first) {
    while (kept >= first + 2 && !turns_left(points[kept - 2], points[kept - 1], next))
      --kept;
    points[kept++] = next;
  };
  for (int run = 0; run < 4; ++run) {
    // Points with equal x may be in any order, because only the outermost of them remains.
    std::sort(begin[run], begin[run + 1], [to_the_right = run < 2](const auto& a, const auto& b) {
      return to_the_right ? a.x() < b.x() : a.x() > b.x();
    });
    const bool is_new = kept == 0 || (points[kept - 1] != corner[run] && points[0] != corner[run]);
    if (is_new) points[kept++] = corner[run];
    const std::size_t first = kept - 1;
    for (const Eigen::Vector2d* p = begin[run]; p != begin[run + 1]; ++p)
      add(Eigen::Vector2d(*p), first);
    while (kept >= first + 2 && !turns_left(points[kept - 2], points[kept - 1], corner[run + 1]))
      --kept;
  }
  return kept;
}

Rectangle smallest_rectangle(const Eigen::Vector2d* corners, std::size_t count) {
  Rectangle best;
  if (count < 2) return best;
  double least = kInfinity;
  std::size_t right = 1, top = 1, left = 1;
  const auto next = [count](std::size_t i) { return i + 1 < count ? i + 1 : 0; };
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d edge = corners[next(i)] - corners[i];
    const double length = std::sqrt(dot(edge, edge));
    const Eigen::Vector2d u = edge / length, v(-u.y(), u.x());
    // Moves a caliper to the next corner while its projection along `direction` grows, at most once around
    // the polygon. `direction` is not normalised, so that the processor need not wait for the square root
    // above.
    const auto advance = [&](std::size_t& at, const Eigen::Vector2d& direction) {
      for (std::size_t steps = 0; steps < count; ++steps) {
        if (!(dot(corners[next(at)] - corners[at], direction) > 0)) break;
        at = next(at);
      }
    };
    advance(right, edge);
    advance(top, {-edge.y(), edge.x()});
    if (i == 0) left = top;
    advance(left, -edge);
    const double width = dot(corners[right] - corners[left], u), height = dot(corners[top] - corners[i], v);
    if (!(width * height < least)) continue;
    least = width * height;
    best = {u, width, height};
  }
  return best;
}

}  // namespace pcl_bv::detail
