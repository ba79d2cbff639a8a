// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reading of the view, the only place that knows of strides, index lists and invalid points.
#include "gather.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

namespace pcl_bv {
namespace {

void check_numbers(const PointView& view) {
  constexpr std::size_t max_number = std::numeric_limits<std::int32_t>::max();
  if (view.indices || view.empty() || view.first + view.count - 1 <= max_number) return;
  throw std::length_error("point number " + std::to_string(view.first + view.count - 1) +
                          " does not fit an index of a cluster (0 .. 2147483647)");
}

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

}  // namespace

template <typename T>
void gather(const PointView& view, ValidPoints<T>& valid) {
  check_numbers(view);
  const PointView sorted = ascending(view, valid.sorted_list);
  valid.points.clear();
  valid.numbers.clear();
  valid.points.reserve(sorted.count);
  valid.numbers.reserve(sorted.count);
  for (std::size_t i = 0; i < sorted.count; ++i) {
    const Coordinates p = load_point(sorted, i);
    if (!is_valid(p)) continue;
    valid.points.push_back({static_cast<T>(p.x), static_cast<T>(p.y), static_cast<T>(p.z)});
    valid.numbers.push_back(static_cast<std::int32_t>(sorted.index(i)));
  }
}

template void gather(const PointView&, ValidPoints<float>&);
template void gather(const PointView&, ValidPoints<double>&);

}  // namespace pcl_bv
