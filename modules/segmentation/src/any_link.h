// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Whether any point of one cell is linked to any point of another, without the n*m tests that two dense
// sheets barely out of each other's reach would cost.
#pragma once

#include "distance.h"

namespace pcl_bv {

/// Points in a row with their box. The order of the points means nothing; any_link() changes it.
template <typename T>
struct PointGroup {
  Point<T>* points;
  std::size_t count;
  Box<T> box;
};

/// Whether squared_distance(p, q) < r2 for some p of a and q of b. Neither is empty.
///
/// Descends into both groups as into kd-trees built on the way: about m^1.5 tests for two parallel sheets of
/// m points each, a handful when the groups are clearly near or apart.
template <typename T>
bool any_link(PointGroup<T> a, PointGroup<T> b, T r2);

extern template bool any_link(PointGroup<float>, PointGroup<float>, float);
extern template bool any_link(PointGroup<double>, PointGroup<double>, double);

}  // namespace pcl_bv
