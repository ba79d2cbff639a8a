// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Distances of points and bounds on distances, in the arithmetic that decides whether two points are linked.
#pragma once

#include <algorithm>
#include <cstddef>

namespace pcl_bv::detail {

template <typename T>
struct Point {
  T x, y, z;
};

/// Returns the squared norm. Adds in the order of PCL (FLANN), x first, with one rounding after each
/// operation.
template <typename T>
T squared_norm(T dx, T dy, T dz) {
  return (dx * dx + dy * dy) + dz * dz;
}

template <typename T>
T squared_distance(const Point<T>& p, const Point<T>& q) {
  return squared_norm(p.x - q.x, p.y - q.y, p.z - q.z);
}

template <typename T>
struct Box {
  Point<T> min, max;

  void extend(const Point<T>& p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
  }
  void extend(const Box& box) {
    min = {std::min(min.x, box.min.x), std::min(min.y, box.min.y), std::min(min.z, box.min.z)};
    max = {std::max(max.x, box.max.x), std::max(max.y, box.max.y), std::max(max.z, box.max.z)};
  }
  Point<T> sides() const { return {max.x - min.x, max.y - min.y, max.z - min.z}; }
};

/// Returns the axis along which the box is longest.
template <typename T>
T Point<T>::*longest_axis(const Box<T>& box) {
  const Point<T> s = box.sides();
  return s.x >= s.y && s.x >= s.z ? &Point<T>::x : s.y >= s.z ? &Point<T>::y : &Point<T>::z;
}

template <typename T>
Box<T> box_of(const Point<T>* points, std::size_t count) {
  Box<T> box{points[0], points[0]};
  for (std::size_t i = 1; i < count; ++i)
    box.extend(points[i]);
  return box;
}

// Rounding is monotone, i.e. a <= b implies fl(a) <= fl(b). So fl(a - c) <= fl(b - c). The same holds for
// squares and for sums of non-negative numbers. So the two bounds below hold for the rounded
// squared_distance() of each pair, without a margin.

/// Returns a lower bound of squared_distance() for all pairs of points in the two boxes.
template <typename T>
T min_squared_distance(const Box<T>& a, const Box<T>& b) {
  const auto gap = [](T a_min, T a_max, T b_min, T b_max) {
    return std::max({T(0), b_min - a_max, a_min - b_max});
  };
  return squared_norm(gap(a.min.x, a.max.x, b.min.x, b.max.x), gap(a.min.y, a.max.y, b.min.y, b.max.y),
                      gap(a.min.z, a.max.z, b.min.z, b.max.z));
}

/// Returns an upper bound of squared_distance() for all pairs of points in the two boxes.
template <typename T>
T max_squared_distance(const Box<T>& a, const Box<T>& b) {
  const auto span = [](T a_min, T a_max, T b_min, T b_max) { return std::max(b_max - a_min, a_max - b_min); };
  return squared_norm(span(a.min.x, a.max.x, b.min.x, b.max.x), span(a.min.y, a.max.y, b.min.y, b.max.y),
                      span(a.min.z, a.max.z, b.min.z, b.max.z));
}

}  // namespace pcl_bv::detail
