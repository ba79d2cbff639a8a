// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Estimates the height of the ground in every cell from the lowest points of the cells with visible ground.
#pragma once

#include <cstdint>
#include <vector>

#include "zone_points.h"

namespace pcl_bv::detail {

/// The surface of the ground. The height of the ground in a cell is base + range * slope, where range is the
/// horizontal distance from the sensor. Heights are in metres, relative to the `plane` of find().
class GroundSurface {
 public:
  struct Line {
    float base, slope;
  };

  /// Computes the line of each cell. The heights in `cells` are relative to `plane`. `max_slope` is the
  /// tangent of the largest angle between the ground and the horizontal. O(cells).
  void find(const CellSummary& cells, const Slope& plane, float max_slope);

  /// Returns the height of point `i` above the ground, metres.
  float clearance(const ZonePoints& points, std::size_t i) const {
    const Line line = lines_[points.cell[i]];
    return points.height[i] - (line.base + points.range[i] * line.slope);
  }

  /// Returns CellSummary::has_object of the cell of point `i`, but 0 in a ditch. Call it only after find().
  std::uint8_t has_object(const ZonePoints& points, std::size_t i) const {
    return has_object_[points.cell[i]];
  }

 private:
  /// The state of a traversal in the current ring, for each sector.
  struct WalkState {
    RingRow height;        // expected height of the ground
    RingRow slope;         // slope of the ground, outwards
    RingRow last_ground;   // height of the last cell with ground
    RingRow since_ground;  // metres from the last cell with ground
    void mix_with_neighbours(float width);
  };

  void estimate_outwards(const CellSummary& cells);
  void interpolate_inwards();
  void lower_at_objects();
  void compute_lines();

  std::size_t rings_ = 0;  // number of rings up to the last with a point
  std::vector<float> height_, last_ground_, since_ground_;
  std::vector<std::uint8_t> seen_, has_object_;
  std::vector<Line> lines_;
};

}  // namespace pcl_bv::detail
