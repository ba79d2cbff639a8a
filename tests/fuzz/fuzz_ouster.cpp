// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "memory_file.h"
#include "ouster_sensor.h"
#include "packet_file.h"
#include "pcl_bv/io/raw_cloud.h"

// Metadata, a zero byte and a capture: every point is finite, and a sweep has at most the points of its
// columns.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_bv::detail;
  const std::string_view all(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(all.find('\0'), all.size());
  static pcl_bv::MemoryFile file;
  file.assign(all.substr(std::min(end + 1, all.size())));
  try {
    const auto metadata = std::make_shared<const OusterMetadata>(parse_ouster_metadata(all.substr(0, end)));
    OusterSensor sensor(metadata, std::make_shared<const OusterGeometry>(*metadata));
    PacketFile packets(file.path());
    SweepQueue queue;
    for (Payload packet; packets.next(packet);) {
      if (packet.size == metadata->packet_size()) sensor.add(packet, queue);
    }
    sensor.finish(queue);
    const std::size_t most = metadata->columns_per_frame * metadata->beams * metadata->profile->returns;
    for (const SensorSweep& sweep : queue.whole) {
      if (sweep.points.size() > most) std::abort();
      for (const SensorPoint& p : sweep.points) {
        if (!std::isfinite(p.x + p.y + p.z)) std::abort();
      }
    }
  } catch (const pcl_bv::IoError& error) {
    if (*error.what() == 0) std::abort();
  }
  return 0;
}
