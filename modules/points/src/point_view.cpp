// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/points/point_view.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "pcl_bv/points/select_points.h"

namespace pcl_bv {
namespace {

// The range of the indices of a view: `begin` is the smallest index, `end` is the largest index plus 1.
struct IndexRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};

IndexRange range_of(const PointView& points) {
  if (points.source != nullptr)
    throw std::invalid_argument("subset: the points must be in memory, not in a source");
  if (points.indices == nullptr) return {points.first, points.first + points.count};
  const auto [low, high] = std::minmax_element(points.indices, points.indices + points.count);
  if (points.count == 0) return {};
  return {static_cast<std::size_t>(*low), static_cast<std::size_t>(*high) + 1};
}

PointView select_checked(const PointView& points, const IndexRange& range, const std::int32_t* selected,
                         std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    const auto index = static_cast<std::size_t>(selected[i]);
    if (selected[i] >= 0 && index >= range.begin && index < range.end) continue;
    throw std::out_of_range(
        "point index " + std::to_string(selected[i]) + " is outside the cloud, whose indices are " +
        (range.begin == range.end ? std::string("none")
                                  : std::to_string(range.begin) + " to " + std::to_string(range.end - 1)));
  }
  return detail::select_points(points, selected, size);
}

}  // namespace

PointView PointView::subset(const std::int32_t* selected, std::size_t size) const {
  return select_checked(*this, range_of(*this), selected, size);
}

std::vector<PointView> subsets(const PointView& points, const IndexLists& lists) {
  const IndexRange range = range_of(points);
  std::vector<PointView> views;
  views.reserve(lists.size());
  for (std::size_t i = 0; i < lists.size(); ++i)
    views.push_back(select_checked(points, range, lists.list(i), lists.list_size(i)));
  return views;
}

}  // namespace pcl_bv
