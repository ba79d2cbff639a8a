// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tests whether any point of one cell is linked to any point of another cell. If two dense parallel sheets
// are just farther apart than the tolerance, most of the n * m pairs of points are never tested.
#pragma once

#include <cstddef>
#include <vector>

#include "distance.h"

namespace pcl_bv::detail {

/// Consecutive points in an array.
template <typename T>
struct PointRun {
  const Point<T>* points;
  std::size_t count;
};

/// Buffers for copies of two runs.
template <typename T>
struct LinkScratch {
  std::vector<Point<T>> a, b;
};

/// Returns the same as any_link(), for many points. First tests two pairs of points that are near each other.
/// Then splits both runs recursively, like k-d trees, and skips parts that are too far apart for a link.
/// Takes about m^1.5 tests for two parallel sheets of m points each.
template <typename T>
bool any_link_of_many(PointRun<T> a, PointRun<T> b, T r2, LinkScratch<T>& scratch);

/// Returns the same as any_link(), for few points. Tests pairs until one is linked.
template <typename T>
bool any_link_of_few(PointRun<T> a, PointRun<T> b, T r2) {
  for (std::size_t i = 0; i < a.count; ++i) {
    for (std::size_t j = 0; j < b.count; ++j) {
      if (squared_distance(a.points[i], b.points[j]) < r2) return true;
    }
  }
  return false;
}

/// Largest number of pairs for which testing all pairs is cheaper than splitting the runs.
inline constexpr std::size_t max_direct_pairs = 256;

/// Returns whether squared_distance(p, q) < r2 for any point p of run `a` and point q of run `b`. Neither run
/// may be empty.
template <typename T>
bool any_link(PointRun<T> a, PointRun<T> b, T r2, LinkScratch<T>& scratch) {
  return a.count * b.count <= max_direct_pairs ? any_link_of_few(a, b, r2)
                                               : any_link_of_many(a, b, r2, scratch);
}

}  // namespace pcl_bv::detail
