// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The points of each class of a tiled cloud.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/segmentation/clusters.h"
#include "pipeline/class_table.h"
#include "tiles.h"

namespace pcl_bv::detail {

/// Points of a tiled cloud and the field with their classes. The point with the number i in `points` must be
/// point i of `tiles`, or NaN.
struct ClassifiedPoints {
  PointView points;
  const Tiles& tiles;
  const std::string& field;
};

/// The points of one class. Other points become NaN.
class ClassPoints final : public PointSource {
 public:
  ClassPoints(const ClassifiedPoints& cloud, std::int64_t value) : cloud_(cloud), value_(value) {}

  PointView view() const {
    PointView view = view_of(*this, cloud_.points.count, cloud_.points.scalar);
    view.first = cloud_.points.first;
    return view;
  }
  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override;

 private:
  ClassifiedPoints cloud_;
  std::int64_t value_;
};

/// The classes of points.
struct Classes {
  std::vector<std::pair<std::int64_t, ClusterOptions>> kept;  ///< By ascending value.
  std::size_t valid = 0;                                      ///< Number of valid points of all classes.
  std::size_t dropped = 0;                                    ///< Number of those of classes to be dropped.
};

/// Finds the classes of valid points in one pass over the points.
Classes find_classes(const ClassifiedPoints& cloud, const ClassTable& table, const ParallelPolicy& policy);

/// Returns the options of the clusters of a class.
ClusterOptions options_of_class(const ClassTable& table, std::optional<std::int64_t> value);

}  // namespace pcl_bv::detail
