// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Failures of tiles. A failure is sent to all ranks before the next step. Otherwise the other ranks would
// wait for the failed rank.
#pragma once

#include <cstddef>
#include <new>
#include <optional>
#include <string>

#include "commands/pcd_bv/tiles.h"
#include "ranks.h"

namespace pcl_bv::detail {

struct TileFailure {
  std::size_t tile;
  std::string reason;
};

/// Calls work(), which reads tiles. Returns the failure if a tile cannot be read.
template <typename Work>
std::optional<TileFailure> run_and_catch(const Work& work) {
  try {
    work();
    return std::nullopt;
  } catch (const TileError& error) {
    return TileFailure{error.tile(), error.what()};
  }
}

/// A collective call. Returns, on all ranks, the failure of the lowest rank that has a failure.
std::optional<TileFailure> first_failure(Ranks& ranks, const std::optional<TileFailure>& own);

/// A collective call. Returns the headers of all tiles. Each rank reads its share of the tiles.
std::vector<TileHeader> describe_tiles(Ranks& ranks, const std::vector<Job>& jobs);

}  // namespace pcl_bv::detail
