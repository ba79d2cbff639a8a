// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The slope of a plane is computed along the directions of the sectors, so points must be in these sectors.
#include "polar_cells.h"

#include <gtest/gtest.h>

namespace pcl_bv::detail {
namespace {

TEST(PolarCells, ThePointInTheMiddleOfASectorIsInIt) {
  for (std::size_t s = 0; s < sector_count; ++s) {
    const auto [u, v] = sector_directions[s];
    for (const double range : {0.75, 20.0}) {
      const auto along = static_cast<float>(range * u), across = static_cast<float>(range * v);
      const std::int32_t cell = cell_of(range_of(along, across), angle_in_turns(along, across));
      EXPECT_EQ(cell % std::int32_t{sector_count}, static_cast<std::int32_t>(s)) << range;
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
