// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The dual-tree search behind any_link().
#include "any_link.h"

#include <utility>

namespace pcl_bv {
namespace {

// Below so many pairs, testing them all is cheaper than splitting (measured on 64-beam sweeps: 64 to 1024
// alike).
constexpr std::size_t few_pairs = 256;

template <typename T>
bool any_link_of_all(const PointGroup<T>& a, const PointGroup<T>& b, T r2) {
  for (std::size_t i = 0; i < a.count; ++i) {
    for (std::size_t j = 0; j < b.count; ++j) {
      if (squared_distance(a.points[i], b.points[j]) < r2) return true;
    }
  }
  return false;
}

template <typename T>
Point<T> extent(const Box<T>& box) {
  return {box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z};
}

template <typename T>
T longest_side(const Box<T>& box) {
  const Point<T> e = extent(box);
  return std::max({e.x, e.y, e.z});
}

// Halves by number along the longest side, so that the depth is logarithmic whatever the spread.
template <typename T>
std::pair<PointGroup<T>, PointGroup<T>> split(const PointGroup<T>& group) {
  const Point<T> e = extent(group.box);
  const T Point<T>::*axis = e.x >= e.y && e.x >= e.z ? &Point<T>::x
                            : e.y >= e.z             ? &Point<T>::y
                                                     : &Point<T>::z;
  Point<T>* const middle = group.points + group.count / 2;
  std::nth_element(group.points, middle, group.points + group.count,
                   [axis](const Point<T>& p, const Point<T>& q) { return p.*axis < q.*axis; });
  const std::size_t half = group.count / 2;
  return {{group.points, half, box_of(group.points, half)},
          {middle, group.count - half, box_of(middle, group.count - half)}};
}

}  // namespace

template <typename T>
bool any_link(PointGroup<T> a, PointGroup<T> b, T r2) {
  if (!(least_squared_distance(a.box, b.box) < r2)) return false;
  if (greatest_squared_distance(a.box, b.box) < r2) return true;
  if (a.count * b.count <= few_pairs) return any_link_of_all(a, b, r2);
  // Two groups without extent were decided above, so the longer one has two points at least.
  if (longest_side(a.box) < longest_side(b.box)) std::swap(a, b);
  auto [near, far] = split(a);
  if (least_squared_distance(far.box, b.box) < least_squared_distance(near.box, b.box)) std::swap(near, far);
  return any_link(near, b, r2) || any_link(far, b, r2);
}

template bool any_link(PointGroup<float>, PointGroup<float>, float);
template bool any_link(PointGroup<double>, PointGroup<double>, double);

}  // namespace pcl_bv
