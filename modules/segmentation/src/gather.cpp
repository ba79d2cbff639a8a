// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "gather.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "ground_checks.h"

namespace pcl_bv {
namespace {

// The same points in strictly ascending order.
PointView ascending(const PointView& view, std::vector<std::int32_t>& sorted_list) {
  if (!view.indices) return view;
  const std::int32_t* const end = view.indices + view.count;
  if (std::adjacent_find(view.indices, end, std::greater_equal<>()) == end) return view;
  sorted_list.assign(view.indices, end);
  std::sort(sorted_list.begin(), sorted_list.end());
  sorted_list.erase(std::unique(sorted_list.begin(), sorted_list.end()), sorted_list.end());
  PointView sorted = view;
  sorted.indices = sorted_list.data();
  sorted.count = sorted_list.size();
  return sorted;
}

// is_valid(); a float is below the limit if it is finite.
bool is_valid(const float (&p)[3]) {
  return 0 * p[0] + 0 * p[1] + 0 * p[2] == 0;
}
bool is_valid(const double (&p)[3]) {
  return pcl_bv::is_valid(Coordinates{p[0], p[1], p[2]});
}

}  // namespace

template <typename T>
void gather(const PointView& view, ValidPoints<T>& valid) {
  check_numbers(view);
  const PointView sorted = ascending(view, valid.sorted_list);
  valid.points.resize(sorted.count);
  valid.numbers.resize(sorted.count);
  constexpr T largest = std::numeric_limits<T>::max();
  valid.box = {{largest, largest, largest}, {-largest, -largest, -largest}};
  std::size_t kept = 0;
  for (std::size_t i = 0; i < sorted.count; ++i) {
    T p[3];
    load_point(sorted, i, p);
    valid.points[kept] = {p[0], p[1], p[2]};
    valid.numbers[kept] = static_cast<std::int32_t>(sorted.index(i));
    if (!is_valid(p)) continue;
    valid.box.extend(valid.points[kept]);
    ++kept;
  }
  valid.points.resize(kept);
  valid.numbers.resize(kept);
}

template void gather(const PointView&, ValidPoints<float>&);
template void gather(const PointView&, ValidPoints<double>&);

}  // namespace pcl_bv
