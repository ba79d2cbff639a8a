// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "hesai_correction.h"
#include "hesai_sensor.h"
#include "memory_file.h"
#include "packet_file.h"
#include "pcl_bv/io/raw_cloud.h"

namespace {

constexpr std::size_t kMirrorFile = 47'176;  // bytes of a correction file with three mirrors

// Reads the correction file at the beginning and removes it.
pcl_bv::detail::HesaiCorrection take_correction(std::string_view& bytes) {
  const bool has_mirrors = bytes.substr(0, 2) == "\xEE\xFF";
  const std::size_t end = std::min(has_mirrors ? kMirrorFile : bytes.find('\0'), bytes.size());
  const std::string_view file = bytes.substr(0, end);
  bytes.remove_prefix(std::min(has_mirrors ? end : end + 1, bytes.size()));
  pcl_bv::detail::HesaiCorrection correction;
  if (has_mirrors) {
    correction.mirrors = pcl_bv::detail::parse_hesai_mirrors(file);
  } else {
    correction.angles = pcl_bv::detail::parse_hesai_correction(file);
  }
  return correction;
}

}  // namespace

// An angle correction file, a zero byte (not after a binary file) and a capture: every point is finite and
// within 328 m, and a sweep has a limited number of points.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_bv::detail;
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  static pcl_bv::MemoryFile file;
  try {
    const HesaiCorrection correction = take_correction(rest);
    file.assign(rest);
    std::map<const HesaiModel*, std::unique_ptr<HesaiSensor>> sensors;
    PacketFile packets(file.path());
    SweepQueue queue;
    for (Payload packet; packets.next(packet);) {
      const HesaiModel* const model = hesai_model(packet);
      if (model == nullptr || !correction.is_for(*model)) continue;
      std::unique_ptr<HesaiSensor>& sensor = sensors[model];
      if (!sensor)
        sensor = std::make_unique<HesaiSensor>(std::make_shared<const HesaiGeometry>(*model, correction));
      sensor->add(packet, queue);
    }
    for (const auto& [model, sensor] : sensors)
      sensor->finish(queue);
    for (const SensorSweep& sweep : queue.whole) {
      if (sweep.points.size() > 2U << 20U) std::abort();
      for (const SensorPoint& p : sweep.points) {
        if (!(std::hypot(p.x, p.y, p.z) < 328)) std::abort();
      }
    }
  } catch (const pcl_bv::IoError& error) {
    if (*error.what() == 0) std::abort();
  }
  return 0;
}
