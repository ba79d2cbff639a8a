// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cmath>
#include <cstdlib>

#include "memory_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/recording/packet_reader.h"

// Any bytes as a capture: every point is finite, and within 262 m unless a Livox measured it, whose
// coordinates have 32 bits.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static pcl_bv::MemoryFile file;
  file.assign({reinterpret_cast<const char*>(data), size});
  try {
    pcl_bv::PacketReader reader(file.path());
    for (pcl_bv::SensorSweep sweep; reader.next(sweep);) {
      const double limit = sweep.frame_id == "livox_frame" ? 5e6 : 263;
      for (const pcl_bv::SensorPoint& p : sweep.points) {
        if (!(std::hypot(p.x, p.y, p.z) < limit)) std::abort();
      }
    }
  } catch (const pcl_bv::IoError& error) {
    if (*error.what() == 0) std::abort();
  }
  return 0;
}
