// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The set-up of the tests of sensors: captures are written as a.pcap, and their sweeps are read.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "pcl_bv/recording/packet_reader.h"
#include "recording_files.h"

namespace pcl_bv {

class CapturedSweeps : public RecordingFiles {
 protected:
  /// Returns the sweeps in a capture. If `sensor` is given, only those of this sensor.
  std::vector<SensorSweep> sweeps_of(const std::string& file, const std::string& sensor = {}) {
    put("a.pcap", file);
    PacketReader reader(at("a.pcap"), sensor);
    model_ = std::string(reader.model());
    std::vector<SensorSweep> sweeps;
    for (SensorSweep sweep; reader.next(sweep);)
      sweeps.push_back(sweep);
    warnings_ = reader.warning_lines();
    return sweeps;
  }
  std::string error_of(const std::string& file) {
    try {
      sweeps_of(file);
    } catch (const IoError& error) {
      return error.what();
    }
    return "no error";
  }
  std::string model_;                  // of the last capture
  std::vector<std::string> warnings_;  // of the last capture
};

/// Coordinates, intensity and time.
using PointKey = std::array<float, 5>;

/// The points of each sweep, sorted, because late packets change their order.
inline std::vector<std::multiset<PointKey>> points_in(const std::vector<SensorSweep>& sweeps) {
  std::vector<std::multiset<PointKey>> all;
  for (const SensorSweep& sweep : sweeps) {
    std::multiset<PointKey>& points = all.emplace_back();
    for (const SensorPoint& p : sweep.points)
      points.insert({p.x, p.y, p.z, p.intensity, static_cast<float>(p.time_ns)});
  }
  return all;
}

/// Both are computed in double, of up to 1049 m, and rounded to float, so at most the last bit differs, or
/// 1e-12 m near zero.
inline bool is_same_coordinate(float got, double expected) {
  const auto rounded = static_cast<float>(expected);
  return got == rounded || std::nextafter(rounded, got) == got || std::abs(got - expected) <= 1e-12;
}

}  // namespace pcl_bv
