// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The points and cells of GroundZones.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/parallel/parts.h"
#include "pcl_bv/points/point_view.h"
#include "plane_search.h"
#include "polar_cells.h"
#include "up_frame.h"

namespace pcl_bv::detail {

/// A point in the frame of the zones. Position and height are relative to the sensor, metres.
struct GroundPoint {
  float u, v, height;
};

/// A plane with height = offset + u * slope_u + v * slope_v.
struct Slope {
  double offset, slope_u, slope_v;
};

/// The frame of the zones. It has horizontal axes, the up direction and the sensor as the origin.
struct ZoneFrame : UpFrame {
  Eigen::Vector3d sensor;

  ZoneFrame(const Eigen::Vector3d& direction, const Eigen::Vector3d& position)
      : UpFrame(direction), sensor(position) {}

  /// Converts a point of the cloud.
  GroundPoint point(const Coordinates& p) const;
  /// Converts a plane of the cloud.
  Slope slope(const Plane& plane) const;
  /// Returns the horizontal plane at `height` below the sensor, in the frame of the cloud.
  Plane level(double height) const;
};

/// A summary of each cell, computed from the points of one part or of all parts.
struct CellSummary {
  /// Height of the lowest point above the plane, metres. It is no_lowest for an empty cell.
  std::vector<float> lowest;
  /// Whether an object stands in the cell, i.e. the cell has points 0.3 to 2 m above its `lowest`.
  std::vector<std::uint8_t> has_object;
};

inline constexpr float no_lowest = 1e30F;

/// A part of the points of a view. One thread processes it.
struct ZonePart {
  std::size_t begin, end;  ///< Range in the view.
  std::size_t valid;       ///< Number of valid points, stored from `begin` on.
  /// Length of the list that this part wrote last: near points in list_near(), ground points in classify().
  std::size_t listed;
  CellSummary cells;
};

/// Joins lists that parts have written to `list`: moves `count_of(part)` elements at part.begin of each part
/// to the end of those of the parts before it. Parts are in ascending order, so elements only move to the
/// front. Returns the number of all elements.
template <typename Parts, typename Count>
std::size_t join_lists(const Parts& parts, std::vector<std::int32_t>& list, const Count& count_of) {
  std::size_t joined = 0;
  for (const auto& part : parts) {
    const auto first = list.begin() + static_cast<std::ptrdiff_t>(part.begin);
    if (joined != part.begin)
      std::copy(first, first + static_cast<std::ptrdiff_t>(count_of(part)),
                list.begin() + static_cast<std::ptrdiff_t>(joined));
    joined += count_of(part);
  }
  return joined;
}

/// The valid points of a view. Each part has its points in the order of the view.
class ZonePoints {
 public:
  PointParts<ZonePart> parts;
  std::vector<std::int32_t> number;  ///< Index in the cloud.
  std::vector<std::uint16_t> cell;
  std::vector<float> range;  ///< Horizontal distance from the sensor, metres.
  /// Height above the sensor, metres. After measure_from() it is the height above the plane.
  std::vector<float> height;

  /// Replaces all points by the valid points of a view. O(n).
  void read(const PointView& view, const ZoneFrame& frame, const ParallelPolicy& policy);

  /// Lists the cloud indices of the points in the first `rings` rings.
  void list_near(std::size_t rings, const ParallelPolicy& policy, std::vector<std::int32_t>& numbers);

  /// Makes the heights relative to `plane`, and computes the summary that cells() returns.
  void measure_from(const Slope& plane, const ParallelPolicy& policy);

  /// Returns the summary of all cells. measure_from() stores it in the first part.
  const CellSummary& cells() const { return parts.front().cells; }

 private:
  void read_part(const PointView& view, const ZoneFrame& frame, ZonePart& part);
  void find_lowest(const Slope& plane, ZonePart& part);
  void fill_pits();
  void find_objects(const std::vector<float>& lowest, ZonePart& part) const;

  std::vector<float> u_, v_;
};

}  // namespace pcl_bv::detail
