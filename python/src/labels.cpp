// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "labels.h"

#include <numeric>

#include "arrays.h"
#include "pcl_bv/points/select_points.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

/// Sorts point indices by label, stably. If all labels are less than the number of points, as the labels of
/// clusters are, uses a counting sort in O(n). Otherwise takes O(n log n).
void sort_by_label(const std::vector<std::int64_t>& of, std::vector<std::int32_t>& numbers) {
  const auto label_of = [&](std::int32_t i) { return of[static_cast<std::size_t>(i)]; };
  std::int64_t max_label = -1;
  for (const std::int32_t i : numbers)
    max_label = std::max(max_label, label_of(i));
  if (max_label >= static_cast<std::int64_t>(of.size())) {
    std::stable_sort(numbers.begin(), numbers.end(),
                     [&](std::int32_t a, std::int32_t b) { return label_of(a) < label_of(b); });
    return;
  }
  std::vector<std::size_t> next(static_cast<std::size_t>(max_label + 2));
  for (const std::int32_t i : numbers)
    ++next[static_cast<std::size_t>(label_of(i)) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<std::int32_t> sorted(numbers.size());
  for (const std::int32_t i : numbers)
    sorted[next[static_cast<std::size_t>(label_of(i))]++] = i;
  numbers.swap(sorted);
}

}  // namespace

LabelGroups::LabelGroups(py::handle labels, const PointView& points) {
  const py::object given = py::hasattr(labels, "labels") ? py::object(labels.attr("labels"))
                                                         : py::reinterpret_borrow<py::object>(labels);
  std::vector<std::int64_t> of = integers(given, "labels", points.count);
  const bool as_written =
      py::isinstance<py::array>(given) && given.attr("dtype").attr("char").cast<std::string>() == "I";
  if (as_written) {
    for (std::int64_t& label : of)
      label = static_cast<std::int32_t>(label);
  }
  if (points.count > std::numeric_limits<std::int32_t>::max())
    raise_value_error("labels", "at most 2147483647 points can be labelled");
  const py::gil_scoped_release unlocked;
  numbers_.reserve(of.size());
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (of[i] >= 0) numbers_.push_back(static_cast<std::int32_t>(i));
  }
  const auto label_of = [&](std::int32_t i) { return of[static_cast<std::size_t>(i)]; };
  sort_by_label(of, numbers_);
  for (std::size_t begin = 0, end = 0; begin < numbers_.size(); begin = end) {
    labels_.push_back(label_of(numbers_[begin]));
    while (end < numbers_.size() && label_of(numbers_[end]) == labels_.back())
      ++end;
    views_.push_back(select_points(points, numbers_.data() + begin, end - begin));
  }
}

}  // namespace pcl_bv::python
