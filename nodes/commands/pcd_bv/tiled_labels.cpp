// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tiled_labels.h"

#include <new>
#include <utility>

#include "commands/shared/messages.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/io/untrusted_text.h"
#include "tiles.h"

namespace pcl_bv::detail {
namespace {

RawCloud load_tile(const Tiles& tiles, std::size_t tile, std::size_t points) {
  try {
    RawCloud cloud = load_cloud(tiles.jobs()[tile], {Serial{}, Isa::scalar});
    if (cloud.size() == points) return cloud;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw TileError(tile, reason_of(error));
  }
  throw TileError(tile, kChangedWhileRead);
}

}  // namespace

void write_labelled(const std::filesystem::path& path, RawCloud cloud,
                    const std::vector<std::uint32_t>& labels) {
  set_uint32_field(cloud, "label", labels);
  create_folder(path.parent_path());
  write_pcd(path, cloud);
}

Status write_tile_labels(
    const Job& job,
    const std::function<std::vector<std::uint32_t>(std::size_t first, std::size_t count)>& labels) {
  Status status = Status::done;
  const Tiles& tiles = *job.tiles;
  for (std::size_t tile = 0; tile < job.tile_labels.size(); ++tile) {
    if (tiles.header(tile).error) continue;
    const PointRange range = tiles.points_of(tile);
    RawCloud cloud = load_tile(tiles, tile, range.second - range.first);
    try {
      write_labelled(job.tile_labels[tile], std::move(cloud),
                     labels(range.first, range.second - range.first));
    } catch (const IoError& error) {
      report_problem(job.tile_labels[tile].string() + ": " + error.what());
      status = Status::failed;
    }
  }
  return status;
}

}  // namespace pcl_bv::detail
