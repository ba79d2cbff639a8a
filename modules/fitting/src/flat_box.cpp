// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The monotone chain and the rotating calipers.

#include "flat_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_bv {
namespace {

double dot(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.x() + a.y() * b.y();
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Whether the corners turn left at b.
bool turns_left(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return cross(b - a, c - a) > 0;
}

// Sorts `count` points along x so that the chain over them is at the front; returns its length.
std::size_t upper_or_lower(Eigen::Vector2d* points, std::size_t count) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d next = points[i];
    while (kept >= 2 && !turns_left(points[kept - 2], points[kept - 1], next))
      --kept;
    std::swap(points[kept++], points[i]);
  }
  return kept;
}

}  // namespace

std::size_t to_convex_chain(Eigen::Vector2d* points, std::size_t count) {
  const auto before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  };
  std::sort(points, points + count, before);
  count = static_cast<std::size_t>(std::unique(points, points + count) - points);
  if (count < 3) return count;
  // The swaps leave the points that are not on the lower chain behind it, with its last one; sorted the other
  // way, and with the first one after them, they give the upper chain.
  const std::size_t lower = upper_or_lower(points, count);
  const Eigen::Vector2d first = points[0];
  std::sort(points + lower - 1, points + count, [&](const auto& a, const auto& b) { return before(b, a); });
  const std::size_t upper = upper_or_lower(points + lower - 1, count - lower + 1);
  std::size_t corners = lower - 1 + upper;
  // The upper chain ended before the first point: it may still bend inward there.
  while (corners > lower && !turns_left(points[corners - 2], points[corners - 1], first))
    --corners;
  return corners;
}

FlatBox least_rectangle(const Eigen::Vector2d* corners, std::size_t count) {
  FlatBox best;
  if (count < 2) return best;
  best.area = std::numeric_limits<double>::infinity();
  std::size_t right = 1, top = 1, left = 1;
  const auto next = [count](std::size_t i) { return i + 1 < count ? i + 1 : 0; };
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d edge = corners[next(i)] - corners[i];
    const double length = std::sqrt(dot(edge, edge));
    const Eigen::Vector2d u = edge / length, v(-u.y(), u.x());
    // Each pointer moves on as long as that gets it farther; a whole turn at most.
    const auto advance = [&](std::size_t& at, const Eigen::Vector2d& direction) {
      for (std::size_t steps = 0; steps < count; ++steps) {
        if (!(dot(corners[next(at)] - corners[at], direction) > 0)) break;
        at = next(at);
      }
    };
    if (i == 0) right = next(0);
    advance(right, u);
    if (i == 0) top = right;
    advance(top, v);
    if (i == 0) left = top;
    advance(left, -u);
    const double width = dot(corners[right] - corners[left], u), height = dot(corners[top] - corners[i], v);
    if (width * height < best.area) best = {u, width * height, std::sqrt(width * width + height * height)};
  }
  return best;
}

}  // namespace pcl_bv
