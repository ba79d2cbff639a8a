// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ground_surface.h"

#include <algorithm>
#include <array>

#include "slope_limit.h"
#include "vector_clones.h"

namespace pcl_bv::detail {
namespace {

// The lowest point of a cell is ground if it is at most `above` metres above the expected height and at most
// `below` metres below it. The limits grow by `above_growth` and `below_growth` for each metre of
// WalkState::since_ground, up to `above_max` and `below_max`. With these values curbs and clods are ground,
// but bonnets and the seats of benches are not.
constexpr float above = 0.12F, above_growth = 0.024F, above_max = 0.225F;
constexpr float below = 0.1F, below_growth = 0.05F, below_max = 1;

// These values replace `above` and `above_growth` in cells with an object. They are small because the lowest
// point may belong to the object.
constexpr float foot_above = 0.02F, foot_growth = 0.01F;

// If the lowest point of a cell is this far below the expected height, the cell is in a ditch, metres. The
// bank of the ditch may rise by 0.3 m and more within the cell. It is not an object.
constexpr float ditch_depth = 0.1F;

// A rise changes the slope by rise / (slope_memory + since_ground). All three are in metres.
constexpr float slope_memory = 2.6F;

// If the lowest point is below the expected height, the expected height falls by at most this much per metre.
// The value is small because the ground behind a ditch mostly has the same height as before it.
constexpr float max_fall = 0.06F;

// since_ground at the centre of the rings, metres. It is not 0 because the height of the plane there is only
// an estimate.
constexpr float first_since_ground = 2;
// since_ground before any ground has been seen, metres. It is larger than every distance within the cells.
constexpr float never_seen = 1000;
constexpr float roughness = 0.02F;  // mean height of bare ground above the lowest point of a cell, metres

}  // namespace

// Mixes the states of neighbouring sectors into the state of each sector, if ground was seen more recently in
// the neighbours. `width` is the width of a sector.
PCL_BV_VECTOR_CLONES void GroundSurface::WalkState::mix_with_neighbours(float width) {
  for (RingRow* row : {&height, &slope, &last_ground, &since_ground})
    row->close();
  const WalkState old = *this;
  for (std::size_t s = 1; s <= sector_count; ++s) {
    const float own = old.since_ground[s], left = old.since_ground[s - 1] + width,
                right = old.since_ground[s + 1] + width;
    const float fresher_left = std::max(own - left, 0.F), fresher_right = std::max(own - right, 0.F);
    const float sum = fresher_left + fresher_right + 1e-9F;
    const float a = fresher_left / sum, b = fresher_right / sum;
    const auto mixed = [&](const RingRow& row) {
      return row[s] + (a * (row[s - 1] - row[s]) + b * (row[s + 1] - row[s]));
    };
    height[s] = mixed(old.height);
    slope[s] = mixed(old.slope);
    last_ground[s] = mixed(old.last_ground);
    since_ground[s] = std::min(own, std::min(left, right));
  }
}

PCL_BV_VECTOR_CLONES void GroundSurface::estimate_outwards(const CellSummary& cells) {
  WalkState state;
  state.height.fill(0), state.slope.fill(0), state.last_ground.fill(0),
      state.since_ground.fill(first_since_ground);
  for (std::size_t ring = 0; ring < rings_; ++ring) {
    const std::size_t first = ring * sector_count;
    const float* const lowest_of = cells.lowest.data() + first;
    const std::uint8_t* const has_object = cells.has_object.data() + first;
    std::uint8_t *const seen_row = seen_.data() + first, *const object_row = has_object_.data() + first;
    for (std::size_t s = 0; s < sector_count; ++s) {
      const float lowest = lowest_of[s];
      const std::uint8_t object = has_object[s];
      float& height = state.height[s + 1];
      float& since_ground = state.since_ground[s + 1];
      float& slope = state.slope[s + 1];
      height += slope * ring_width;
      since_ground += ring_width;
      const float up = object != 0 ? foot_above + foot_growth * since_ground
                                   : std::min(above_max, above + above_growth * since_ground);
      const float down = std::min(below_max, below + below_growth * since_ground);
      const float rise = lowest - height;
      const bool seen = rise <= up && rise >= -down;
      slope = seen ? slope + rise / (since_ground + slope_memory) : slope;
      height = seen ? std::max(lowest, height - max_fall * ring_width) : height;
      state.last_ground[s + 1] = seen ? lowest : state.last_ground[s + 1];
      since_ground = seen ? 0 : since_ground;
      seen_row[s] = seen;
      object_row[s] = seen && rise < -ditch_depth ? std::uint8_t{0} : object;
    }
    state.mix_with_neighbours(width_of(ring));
    for (std::size_t s = 0; s < sector_count; ++s)
      height_[first + s] = seen_[first + s] != 0 ? cells.lowest[first + s] : state.height[s + 1];
    std::copy_n(state.last_ground.data() + 1, sector_count, last_ground_.data() + first);
    std::copy_n(state.since_ground.data() + 1, sector_count, since_ground_.data() + first);
  }
}

// Interpolates the height linearly between two cells with visible ground in the same sector.
PCL_BV_VECTOR_CLONES void GroundSurface::interpolate_inwards() {
  WalkState state;
  state.slope.fill(0), state.height.fill(0), state.last_ground.fill(0), state.since_ground.fill(never_seen);
  for (std::size_t ring = rings_; ring-- > 0;) {
    const std::size_t first = ring * sector_count;
    for (std::size_t s = 0; s < sector_count; ++s) {
      const std::size_t i = first + s;
      float& since_ground = state.since_ground[s + 1];
      since_ground += ring_width;
      const float known = height_[i];
      const float share =
          since_ground < never_seen ? since_ground_[i] / (since_ground + since_ground_[i]) : 0;
      const float between = last_ground_[i] + share * (state.height[s + 1] - last_ground_[i]);
      height_[i] = seen_[i] != 0 || since_ground >= never_seen ? known : between;
      state.height[s + 1] = seen_[i] != 0 ? known : state.height[s + 1];
      since_ground = seen_[i] != 0 ? 0 : since_ground;
    }
    state.mix_with_neighbours(width_of(ring));
  }
}

// Lowers the height of a cell with an object to the mean height of the cells at both sides in the same ring,
// one or two sectors away. The lowest point of such a cell is often on the foot of the object, while the
// ground in front of the object is visible in the next sectors. Most errors of the surface at objects
// are upwards.
PCL_BV_VECTOR_CLONES void GroundSurface::lower_at_objects() {
  constexpr std::size_t margin = 2;
  std::array<float, sector_count + 2 * margin> old;
  for (std::size_t ring = 0; ring < rings_; ++ring) {
    float* const row = height_.data() + ring * sector_count;
    const std::uint8_t* const has_object = has_object_.data() + ring * sector_count;
    std::copy_n(row + sector_count - margin, margin, old.data());
    std::copy_n(row, sector_count, old.data() + margin);
    std::copy_n(row, margin, old.data() + margin + sector_count);
    for (std::size_t s = 0; s < sector_count; ++s) {
      const float near = old[s + 1] + old[s + 3], far = old[s] + old[s + 4];
      const float lowered = std::min(old[s + 2], 0.5F * std::min(near, far));
      row[s] = has_object[s] != 0 ? lowered : old[s + 2];
    }
  }
}

PCL_BV_VECTOR_CLONES void GroundSurface::compute_lines() {
  lines_.resize(cell_count);
  for (std::size_t ring = 0; ring < rings_; ++ring) {
    const std::size_t inner = ring > 0 ? ring - 1 : 0, outer = std::min(ring + 1, rings_ - 1);
    const bool open = ring == 0 || ring == ring_count - 1;
    const float over =
        open ? 0 : 1 / (ring_width * static_cast<float>(std::max<std::size_t>(outer - inner, 1)));
    for (std::size_t s = 0; s < sector_count; ++s) {
      const float slope = (height_[outer * sector_count + s] - height_[inner * sector_count + s]) * over;
      const float height = height_[ring * sector_count + s];
      lines_[ring * sector_count + s] = {height + roughness - slope * middle_of(ring), slope};
    }
  }
}

void GroundSurface::find(const CellSummary& cells, const Slope& plane, float max_slope) {
  std::size_t last = cell_count;
  while (last > 0 && cells.lowest[last - 1] == no_lowest)
    --last;
  rings_ = (last + sector_count - 1) / sector_count;
  height_.resize(cell_count), last_ground_.resize(cell_count), since_ground_.resize(cell_count),
      seen_.resize(cell_count), has_object_.resize(cell_count);
  estimate_outwards(cells);
  interpolate_inwards();
  limit_slopes(height_.data(), rings_, plane, max_slope);
  lower_at_objects();
  compute_lines();
}

}  // namespace pcl_bv::detail
