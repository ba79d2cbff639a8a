// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What fails on one rank is known to all before the next step, or they would wait for it.
#pragma once

#include <cstddef>
#include <new>
#include <optional>
#include <string>

#include "commands/pcd_bv/tiles.h"
#include "ranks.h"

namespace pcl_bv {

struct TileFailure {
  std::size_t tile;
  std::string reason;
};

/// Does what reads tiles; if one fails, which.
template <typename Work>
std::optional<TileFailure> attempt(const Work& work) {
  try {
    work();
    return std::nullopt;
  } catch (const TileError& error) {
    return TileFailure{error.tile(), error.what()};
  }
}

/// The failure of the lowest rank that has one, the same for all ranks, which all call this.
std::optional<TileFailure> agreed(Ranks& ranks, const std::optional<TileFailure>& own);

/// Headers of all tiles, of which each rank has read its share.
std::vector<TileHeader> describe_tiles(Ranks& ranks, const std::vector<Job>& jobs);

}  // namespace pcl_bv
