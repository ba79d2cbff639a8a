// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Groups points by label.
#pragma once

#include "arguments.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv::python {
using namespace detail;

/// The points of a view, grouped by label: one view per label.
class LabelGroups {
 public:
  /// `labels` has an integer for each point, or is an object with the attribute `labels`, such as Clusters.
  /// Points with a negative label are in no group. Labels of type uint32 are first converted to int32. The
  /// labels that pcd_bv writes for ground and for points without a cluster then become negative.
  LabelGroups(py::handle labels, const PointView& points);

  std::size_t size() const { return views_.size(); }
  std::int64_t label(std::size_t i) const { return labels_[i]; }  ///< Ascending.
  const std::vector<PointView>& views() const { return views_; }

 private:
  std::vector<std::int64_t> labels_;
  std::vector<std::int32_t> numbers_;  // point indices, sorted by label
  std::vector<PointView> views_;
};

}  // namespace pcl_bv::python
