// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "slope_limit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vector_clones.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t max_sectors = 16;  // on either side of a cell

class SlopeLimit {
 public:
  SlopeLimit(float* heights, std::size_t rings, float max_slope)
      : heights_(heights), rings_(rings), max_slope_(max_slope) {}

  void run() {
    for (std::size_t ring = 0; ring < rings_; ++ring)
      limit(ring, ring, [&](std::size_t steps) { return ring - steps; });
    for (std::size_t ring = rings_; ring-- > 0;)
      limit(ring, rings_ - 1 - ring, [&](std::size_t steps) { return ring + steps; });
  }

 private:
  // Limits the heights of `ring` by its own cells and by the cells of at most `max_rings` finished rings.
  // at(steps) is the ring that is `steps` rings away.
  template <typename At>
  void limit(std::size_t ring, std::size_t max_rings, const At& at) {
    for (std::size_t sectors = 1; sectors <= max_sectors; sectors *= 2)
      limit_by(ring, ring, 0, sectors);
    // Number of sectors with a total width of ring_width, before rounding.
    const float square = ring_width / width_of(ring);
    const auto sectors =
        std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(square)), 1, max_sectors);
    const auto max_steps = static_cast<std::size_t>(1 / square) + 1;
    if (max_rings > 0) limit_by(ring, at(1), 1, 0);
    for (std::size_t steps = 1; steps <= std::min(max_rings, max_steps); ++steps)
      limit_by(ring, at(steps), steps, sectors);
  }

  // Limits the heights of `ring` by the cells of ring `from`, which is `steps` rings away. Uses the cells
  // that are `sectors` sectors to either side.
  PCL_BV_VECTOR_CLONES void limit_by(std::size_t ring, std::size_t from, std::size_t steps,
                                     std::size_t sectors) {
    const float across = width_of(ring) * static_cast<float>(sectors);
    const float along = ring_width * static_cast<float>(steps);
    const float climb = max_slope_ * std::sqrt(along * along + across * across);
    const float* const row = heights_ + from * sector_count;
    std::array<float, sector_count + 2 * max_sectors> other;
    std::copy_n(row, sector_count, other.data() + max_sectors);
    std::copy_n(row + sector_count - max_sectors, max_sectors, other.data());
    std::copy_n(row, max_sectors, other.data() + sector_count + max_sectors);
    float* const own = heights_ + ring * sector_count;
    const float *const left = other.data() + max_sectors - sectors, *const right = left + 2 * sectors;
    for (std::size_t s = 0; s < sector_count; ++s)
      own[s] = std::min(own[s], std::min(left[s], right[s]) + climb);
  }

  float* heights_;
  std::size_t rings_;
  float max_slope_;
};

void add_plane(float* heights, std::size_t rings, double slope_u, double slope_v) {
  std::array<float, sector_count> outwards;
  for (std::size_t s = 0; s < sector_count; ++s) {
    const Direction& d = sector_directions[s];
    outwards[s] = static_cast<float>(d.u * slope_u + d.v * slope_v);
  }
  for (std::size_t ring = 0; ring < rings; ++ring) {
    for (std::size_t s = 0; s < sector_count; ++s)
      heights[ring * sector_count + s] += middle_of(ring) * outwards[s];
  }
}

}  // namespace

void limit_slopes(float* heights, std::size_t rings, const Slope& plane, float max_slope) {
  add_plane(heights, rings, plane.slope_u, plane.slope_v);
  SlopeLimit(heights, rings, max_slope).run();
  add_plane(heights, rings, -plane.slope_u, -plane.slope_v);
}

}  // namespace pcl_bv::detail
