// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "any_link.h"

#include <utility>

namespace pcl_bv::detail {
namespace {

// Consecutive points and their box. The order of the points has no meaning.
template <typename T>
struct Group {
  Point<T>* points;
  std::size_t count;
  Box<T> box;
};

template <typename T>
T longest_side(const Box<T>& box) {
  return box.sides().*longest_axis(box);
}

// Splits a group into halves at the median along the longest side of its box, so that the depth of the
// recursion is logarithmic for any distribution.
template <typename T>
std::pair<Group<T>, Group<T>> split(const Group<T>& group) {
  const auto axis = longest_axis(group.box);
  Point<T>* const middle = group.points + group.count / 2;
  std::nth_element(group.points, middle, group.points + group.count,
                   [axis](const Point<T>& p, const Point<T>& q) { return p.*axis < q.*axis; });
  const std::size_t half = group.count / 2;
  return {{group.points, half, box_of(group.points, half)},
          {middle, group.count - half, box_of(middle, group.count - half)}};
}

template <typename T>
bool any_link_of_groups(Group<T> a, Group<T> b, T r2) {
  if (!(min_squared_distance(a.box, b.box) < r2)) return false;
  if (max_squared_distance(a.box, b.box) < r2) return true;
  if (a.count * b.count <= max_direct_pairs) {
    return any_link_of_few(PointRun<T>{a.points, a.count}, PointRun<T>{b.points, b.count}, r2);
  }
  // If each box is a single position, one of the first two tests has returned. So here the group with the
  // longer box has at least two points.
  if (longest_side(a.box) < longest_side(b.box)) std::swap(a, b);
  auto [near, far] = split(a);
  if (min_squared_distance(far.box, b.box) < min_squared_distance(near.box, b.box)) std::swap(near, far);
  return any_link_of_groups(near, b, r2) || any_link_of_groups(far, b, r2);
}

template <typename T>
Group<T> copy_of(const PointRun<T>& run, std::vector<Point<T>>& copy) {
  copy.assign(run.points, run.points + run.count);
  return {copy.data(), run.count, box_of(run.points, run.count)};
}

template <typename T>
struct Nearest {
  const Point<T>* point;
  T squared_distance;
};

template <typename T>
Nearest<T> nearest(const PointRun<T>& run, const Point<T>& to) {
  Nearest<T> best{run.points, squared_distance(run.points[0], to)};
  for (const Point<T>* p = run.points + 1; p != run.points + run.count; ++p) {
    const T d2 = squared_distance(*p, to);
    if (d2 < best.squared_distance) best = {p, d2};
  }
  return best;
}

// Let p be the point of run `a` that is nearest to the first point of run `b`. Returns whether p is linked to
// this first point, or to the point of `b` that is nearest to p. This finds most links.
template <typename T>
bool nearest_points_linked(const PointRun<T>& a, const PointRun<T>& b, T r2) {
  const Nearest<T> of_a = nearest(a, *b.points);
  return of_a.squared_distance < r2 || nearest(b, *of_a.point).squared_distance < r2;
}

}  // namespace

template <typename T>
bool any_link_of_many(PointRun<T> a, PointRun<T> b, T r2, LinkScratch<T>& scratch) {
  if (nearest_points_linked(a, b, r2)) return true;
  return any_link_of_groups(copy_of(a, scratch.a), copy_of(b, scratch.b), r2);
}

template bool any_link_of_many(PointRun<float>, PointRun<float>, float, LinkScratch<float>&);
template bool any_link_of_many(PointRun<double>, PointRun<double>, double, LinkScratch<double>&);

}  // namespace pcl_bv::detail
