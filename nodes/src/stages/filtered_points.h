// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A filter for clouds that are not held: it drops points as they come past.
#pragma once

#include <utility>

#include "pcl_bv/kernels/point_source.h"
#include "pcl_bv/parallel/policy.h"
#include "stages/filter.h"

namespace pcl_bv {

/// The points of a view; those that the filter drops are not valid (NaN).
class FilteredPoints final : public PointSource {
 public:
  /// Keeps the view, whose points are not of an index list, and their owner.
  FilteredPoints(const PointView& points, std::shared_ptr<const void> owner,
                 std::shared_ptr<const PointFilter> filter)
      : points_(points), owner_(std::move(owner)), filter_(std::move(filter)) {}

  /// What is dropped, by reason: a pass over all points.
  Counts count(const ParallelPolicy& policy) const;

  /// Points have the numbers that they have in the view.
  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override;

 private:
  PointView points_;
  std::shared_ptr<const void> owner_;
  std::shared_ptr<const PointFilter> filter_;
};

}  // namespace pcl_bv
