// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "pcl_bv/parallel/parts.h"
#include "pcl_bv/parallel/policy.h"
#include "pcl_bv/points/point_view.h"
#include "plane_search.h"
#include "polar_cells.h"
#include "up_frame.h"

namespace pcl_bv {

/// A place beside the sensor, and its height above it.
struct GroundPoint {
  float u, v, height;
};

/// height = offset + u * slope_u + v * slope_v
struct Slope {
  double offset, slope_u, slope_v;
};

/// The cloud as seen by the zones.
struct ZoneFrame : UpFrame {
  Eigen::Vector3d sensor;

  ZoneFrame(const Eigen::Vector3d& direction, const Eigen::Vector3d& place)
      : UpFrame(direction), sensor(place) {}

  GroundPoint point(const Coordinates& p) const;
  Slope slope(const Plane& plane) const;
  Plane level(double height) const;
};

/// What the cells of some points hold.
struct CellFacts {
  std::vector<float> low;            ///< Height of the lowest point over the plane, metres; no_low: none.
  std::vector<std::uint8_t> stands;  ///< Whether something stands there: points above the lowest one.
};

inline constexpr float no_low = 1e30F;

/// Points of a view that one thread takes.
struct ZonePart {
  std::size_t begin, end;  ///< In the view.
  std::size_t kept;        ///< Valid ones, which lie from `begin` on.
  CellFacts cells;
};

/// The valid points of a view, part by part in its order.
class ZonePoints {
 public:
  Parts<ZonePart> parts;
  std::vector<std::int32_t> number;  ///< In the cloud.
  std::vector<std::uint16_t> cell;
  std::vector<float> range;   ///< Metres from the centre.
  std::vector<float> height;  ///< Metres above the plane that place() was told.

  /// Replaces all points. O(n).
  void read(const PointView& view, const ZoneFrame& frame, const ParallelPolicy& policy);

  /// Numbers of the points in the first `rings` rings.
  void list_near(std::size_t rings, std::vector<std::int32_t>& numbers) const;

  /// Heights become those over `plane`; what all cells hold is then in that of the first part.
  void place(const Slope& plane, const ParallelPolicy& policy);

  const CellFacts& cells() const { return parts.front().cells; }

 private:
  void read_part(const PointView& view, const ZoneFrame& frame, ZonePart& part);
  void find_lows(const Slope& plane, ZonePart& part);
  void fill_pits();
  void find_standing(const std::vector<float>& low, ZonePart& part) const;

  std::vector<float> u_, v_;
};

}  // namespace pcl_bv
