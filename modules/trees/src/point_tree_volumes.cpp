// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <bit>

#include "pcl_bv/numeric/float_environment.h"
#include "point_tree_state.h"
#include "volume_walk.h"

namespace pcl_bv {
using namespace detail;
bool PointTree::any_inside(const AnyVolume& volume) const {
  if (const auto* const sphere = std::get_if<Sphere>(&volume)) return any_inside(*sphere);
  const FloatEnvironment environment;
  return walk_inside(state().isa, state().tree, volume, [](std::size_t, std::uint32_t) { return true; });
}

std::size_t PointTree::count_inside(const AnyVolume& volume) const {
  const FloatEnvironment environment;
  std::size_t count = 0;
  walk_inside(state().isa, state().tree, volume, [&](std::size_t, std::uint32_t bits) {
    count += static_cast<std::size_t>(std::popcount(bits));
    return false;
  });
  return count;
}

void PointTree::all_inside(const AnyVolume& volume, std::vector<std::int32_t>& indices) const {
  const FloatEnvironment environment;
  indices.clear();
  walk_inside(state().isa, state().tree, volume, [&](std::size_t packet, std::uint32_t bits) {
    for (; bits != 0; bits &= bits - 1)
      indices.push_back(
          state().tree.indices[packet * kTreeWidth + static_cast<std::size_t>(std::countr_zero(bits))]);
    return false;
  });
  std::sort(indices.begin(), indices.end());
}

}  // namespace pcl_bv
