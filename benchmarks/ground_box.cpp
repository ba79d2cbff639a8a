// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ground_box.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl_bv::bench {
namespace {

using Polygon = std::vector<Eigen::Vector2d>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Polygon corners_of(const GroundBox& box) {  // counter-clockwise
  const Eigen::Vector2d along(std::cos(box.yaw), std::sin(box.yaw)), left(-along.y(), along.x());
  const Eigen::Vector2d u = along * (box.length / 2), v = left * (box.width / 2);
  return {box.center - u - v, box.center + u - v, box.center + u + v, box.center - u + v};
}

// Returns the part of a convex polygon to the left of the line from a to b (Sutherland and Hodgman 1974).
Polygon clipped(const Polygon& polygon, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  Polygon inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double left_p = cross(b - a, p - a), left_q = cross(b - a, q - a);
    if (left_p >= 0) inside.push_back(p);
    if ((left_p > 0 && left_q < 0) || (left_p < 0 && left_q > 0))
      inside.push_back(p + (q - p) * (left_p / (left_p - left_q)));
  }
  return inside;
}

double area_of(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    twice += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  return twice / 2;
}

}  // namespace

double ground_iou(const GroundBox& a, const GroundBox& b) {
  const double diagonals = std::hypot(a.length, a.width) + std::hypot(b.length, b.width);
  if (2 * (a.center - b.center).norm() > diagonals) return 0;  // most pairs are far apart
  Polygon both = corners_of(a);
  const Polygon other = corners_of(b);
  for (std::size_t i = 0; i < other.size(); ++i)
    both = clipped(both, other[i], other[(i + 1) % other.size()]);
  const double shared = std::max(0.0, area_of(both)), all = a.area() + b.area() - shared;
  return all > 0 ? std::min(1.0, shared / all) : 0;
}

}  // namespace pcl_bv::bench
