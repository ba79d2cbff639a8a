// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Shows what --progress asks for while tiles are read.
#pragma once

#include "options.h"
#include "tiles.h"

namespace pcl_bv::detail {

/// Shows the points that were read, the time and the most memory that the process has taken, on standard
/// error if that is a terminal and --progress is given. The line goes away at the end.
class TileProgress {
 public:
  TileProgress(Tiles& tiles, const Options& options);
  ~TileProgress();
  TileProgress(const TileProgress&) = delete;
  TileProgress& operator=(const TileProgress&) = delete;

 private:
  Tiles& tiles_;
};

}  // namespace pcl_bv::detail
