// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The ground's height in every cell, from the lowest points of those where it is seen.
#pragma once

#include <cstdint>
#include <vector>

#include "zone_points.h"

namespace pcl_bv {

/// The ground over the plane around the sensor, cell by cell: base + range * slope, metres.
class GroundSurface {
 public:
  struct Line {
    float base, slope;
  };

  /// Replaces all lines. `plane`: over which the lows are; `max_slope`: of the ground against the level, a
  /// tangent. O(cells).
  void find(const CellFacts& cells, const Slope& plane, float max_slope);

  /// Of point `i`, metres.
  float clearance(const ZonePoints& points, std::size_t i) const {
    const Line line = lines_[points.cell[i]];
    return points.height[i] - (line.base + points.range[i] * line.slope);
  }

 private:
  /// What a walk knows in each sector where it has come to.
  struct Front {
    RingRow height;  // expected
    RingRow slope;   // outwards
    RingRow anchor;  // height where ground was last seen
    RingRow age;     // metres since then
    void share(float width);
  };

  void walk_out(const CellFacts& cells);
  void walk_in();
  void connect();

  std::size_t rings_ = 0;  // up to the last one that holds a point
  std::vector<float> height_, anchor_, age_;
  std::vector<std::uint8_t> seen_;
  std::vector<Line> lines_;
};

}  // namespace pcl_bv
