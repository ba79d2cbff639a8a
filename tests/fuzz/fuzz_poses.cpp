// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files of poses. The first byte is the number of frames, of which KITTI's format has a pose each.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "memory_file.h"
#include "stream/sources/sources.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_bv;
  if (size == 0) return 0;
  static MemoryFile memory;
  memory.assign({reinterpret_cast<const char*>(data) + 1, size - 1});
  try {
    const Poses poses(memory.path(), data[0]);
    for (const std::int64_t stamp : {std::int64_t{0}, std::int64_t{1} << 60, INT64_MIN, INT64_MAX}) {
      const std::optional<Pose> pose = poses.at(0, stamp);
      if (pose && !pose->linear().isUnitary(1e-6)) std::abort();
    }
  } catch (const IoError&) {
  }
  return 0;
}
