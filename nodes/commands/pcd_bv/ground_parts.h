// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The ground of clouds that are processed in shares: each share gives the lowest points of its cells, and
// from those of all shares each process computes the surface of the whole cloud near its share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "inputs.h"
#include "options.h"
#include "pcl_bv/report/object_file.h"
#include "pcl_bv/segmentation/slope_surface.h"
#include "tiles.h"

namespace pcl_bv::detail {

/// The ground of a cloud near a share.
struct CloudGround {
  SlopeSurface surface;
  std::uint64_t check_sum;  ///< Of the files, in any order.
};

/// Writes the file of a share. Throws TileError for an input that fails, and IoError.
void write_ground_part(const Tiles& tiles, const ShareOption& share, const Options& options,
                       const std::filesystem::path& path, FileLife life);

/// Computes the ground of a share of a cloud from the files of all shares of the cloud, whose number may be
/// another. Throws IoError, with the file, if one cannot be read, is missing or belongs to another cloud.
CloudGround read_ground_parts(const Tiles& tiles, const ShareOption& share, const Options& options,
                              const std::vector<std::string>& files);
/// As above, for the files of --ground-parts.
CloudGround read_ground_parts(const Tiles& tiles, const ShareOption& share, const Options& options);

}  // namespace pcl_bv::detail
