// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "town_files.h"

#include <atomic>
#include <new>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv::detail {

void write_town(const TownSequence& spec, const std::filesystem::path& folder) {
  const Town town(spec.options);
  std::atomic<bool> failed = false;  // the other tiles would fail, too
  for_each_chunk(Threads{}, spec.tiles, [&](std::size_t number) {
    if (failed) return;
    const TownTile tile = town_tile(number);
    const std::filesystem::path path = folder / town_file_name(tile);
    try {
      write_pcd(path, to_raw_cloud(town.tile(tile)));
    } catch (const IoError& error) {
      failed = true;
      throw IoError(path.string() + ": " + error.what());
    } catch (const std::bad_alloc&) {
      failed = true;
      throw IoError(path.string() + ": not enough memory for so many points");
    }
  });
}

}  // namespace pcl_bv::detail
