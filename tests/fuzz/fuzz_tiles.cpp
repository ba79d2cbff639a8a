// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Contents of 3D Tiles: .pnts, .glb and .b3dm files.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "tile_content.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_bv;
  using namespace pcl_bv::detail;
  try {
    if (tile_points({reinterpret_cast<const char*>(data), size}).size() % 3 != 0) std::abort();
  } catch (const IoError&) {
  }
  return 0;
}
