// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cmath>
#include <cstdlib>
#include <map>

#include "hesai_correction.h"
#include "hesai_sensor.h"
#include "memory_file.h"
#include "packet_file.h"
#include "pcl_bv/io/raw_cloud.h"

// An angle correction file, a zero byte and a capture: every point is finite and within 262 m, and a sweep
// has a limited number of points.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_bv::detail;
  const std::string_view all(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(all.find('\0'), all.size());
  static pcl_bv::MemoryFile file;
  file.assign(all.substr(std::min(end + 1, all.size())));
  try {
    const std::vector<HesaiAngles> angles = parse_hesai_correction(all.substr(0, end));
    std::map<const HesaiModel*, std::unique_ptr<HesaiSensor>> sensors;
    PacketFile packets(file.path());
    SweepQueue queue;
    for (Payload packet; packets.next(packet);) {
      const HesaiModel* const model = hesai_model(packet);
      if (model == nullptr || model->channels != angles.size()) continue;
      std::unique_ptr<HesaiSensor>& sensor = sensors[model];
      if (!sensor)
        sensor = std::make_unique<HesaiSensor>(std::make_shared<const HesaiGeometry>(*model, angles));
      sensor->add(packet, queue);
    }
    for (const auto& [model, sensor] : sensors)
      sensor->finish(queue);
    for (const SensorSweep& sweep : queue.whole) {
      if (sweep.points.size() > 2U << 20U) std::abort();
      for (const SensorPoint& p : sweep.points) {
        if (!(std::hypot(p.x, p.y, p.z) < 263)) std::abort();
      }
    }
  } catch (const pcl_bv::IoError& error) {
    if (*error.what() == 0) std::abort();
  }
  return 0;
}
