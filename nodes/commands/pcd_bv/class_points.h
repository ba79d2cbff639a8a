// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The points of each class of a tiled cloud.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_source.h"
#include "tiles.h"

namespace pcl_bv::detail {

/// A tiled cloud and the field with the classes of its points. Point i of `points` must be point i of
/// `tiles`, or NaN.
struct ClassifiedPoints {
  PointView points;
  const Tiles& tiles;
  const std::string& field;
};

/// The points of one class. Other points become NaN.
class ClassPoints final : public PointSource {
 public:
  ClassPoints(const ClassifiedPoints& cloud, std::int64_t value) : cloud_(cloud), value_(value) {}

  PointView view() const { return view_of(*this, cloud_.points.count, cloud_.points.scalar); }
  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override;

 private:
  ClassifiedPoints cloud_;
  std::int64_t value_;
};

/// Returns the number of valid points of each class that has some, in one pass over the points.
std::map<std::int64_t, std::size_t> count_classes(const ClassifiedPoints& cloud,
                                                  const ParallelPolicy& policy);

}  // namespace pcl_bv::detail
