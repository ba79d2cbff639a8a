// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "valid_points.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "ground_checks.h"
#include "pcl_bv/points/select_points.h"

namespace pcl_bv::detail {
namespace {

// Returns a view of the same points in strictly ascending order of their index.
PointView ascending(const PointView& view, std::vector<std::int32_t>& sorted_list) {
  if (!view.indices) return view;
  const std::int32_t* const end = view.indices + view.count;
  if (std::adjacent_find(view.indices, end, std::greater_equal<>()) == end) return view;
  sorted_list.assign(view.indices, end);
  std::sort(sorted_list.begin(), sorted_list.end());
  sorted_list.erase(std::unique(sorted_list.begin(), sorted_list.end()), sorted_list.end());
  return select_points(view, sorted_list);
}

// Returns the same as is_valid() of point_view.h, for arrays. Every finite float is within the coordinate
// limit.
bool is_valid(const float (&p)[3]) {
  return 0 * p[0] + 0 * p[1] + 0 * p[2] == 0;
}
bool is_valid(const double (&p)[3]) {
  return pcl_bv::is_valid(Coordinates{p[0], p[1], p[2]});
}

// Copies the valid points of a part of `points` to `valid`, without gaps, starting at position part.begin.
// Sets their box and number in `part`.
template <typename T>
void copy_valid_part(const PointView& points, ValidPoints<T>& valid, CopyPart<T>& part) {
  constexpr T largest = std::numeric_limits<T>::max();
  const PointView view = points;  // a local copy; the compiler need not reload its fields after each store
  part.box = {{largest, largest, largest}, {-largest, -largest, -largest}};
  std::size_t to = part.begin;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    T p[3];
    load_point(view, i, p);
    valid.points[to] = {p[0], p[1], p[2]};
    valid.numbers[to] = static_cast<std::int32_t>(view.index(i));
    if (!is_valid(p)) continue;
    part.box.extend(valid.points[to]);
    ++to;
  }
  part.valid = to - part.begin;
}

// Moves the points of a part to position `to`.
template <typename T>
void append(const CopyPart<T>& from, std::size_t to, ValidPoints<T>& valid) {
  const auto move_down = [&](auto& all) {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(from.begin);
    std::copy_n(first, from.valid, all.begin() + static_cast<std::ptrdiff_t>(to));
  };
  if (to == from.begin) return;
  move_down(valid.points);
  move_down(valid.numbers);
}

}  // namespace

template <typename T>
void copy_valid_points(const PointView& view, const ParallelPolicy& policy, ValidPoints<T>& valid) {
  check_indices(view);
  const PointView sorted = ascending(view, valid.sorted_list);
  valid.points.resize(sorted.count);
  valid.numbers.resize(sorted.count);
  valid.parts.cut(sorted.count, policy);
  valid.parts.for_each(policy, [&](CopyPart<T>& part) { copy_valid_part(sorted, valid, part); });
  std::size_t count = 0;
  valid.box = valid.parts.front().box;
  for (const CopyPart<T>& part : valid.parts) {
    if (part.valid == 0) continue;
    append(part, count, valid);
    count += part.valid;
    valid.box.extend(part.box.min);
    valid.box.extend(part.box.max);
  }
  valid.points.resize(count);
  valid.numbers.resize(count);
}

template void copy_valid_points(const PointView&, const ParallelPolicy&, ValidPoints<float>&);
template void copy_valid_points(const PointView&, const ParallelPolicy&, ValidPoints<double>&);

}  // namespace pcl_bv::detail
