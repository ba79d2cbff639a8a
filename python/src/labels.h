// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Points told apart by labels, as views.
#pragma once

#include "arguments.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv::python {

class LabelGroups {
 public:
  /// `labels`: an integer for each point, or Clusters. Negative ones are no label, nor are those of uint32
  /// that are such as int32: what pcd_bv's labels call ground and none.
  LabelGroups(py::handle labels, const PointView& points);

  std::size_t size() const { return views_.size(); }
  std::int64_t label(std::size_t i) const { return labels_[i]; }  ///< Ascending.
  const std::vector<PointView>& views() const { return views_; }

 private:
  std::vector<std::int64_t> labels_;
  std::vector<std::int32_t> numbers_;  // of the points, label by label
  std::vector<PointView> views_;
};

}  // namespace pcl_bv::python
