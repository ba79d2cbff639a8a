// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A return, in metres in the sensor's frame: z up, y where the azimuth is 0, x where it is 90 degrees.
struct VelodynePoint {
  float x = 0, y = 0, z = 0;
  float intensity = 0;        ///< 0 to 255.
  std::uint32_t ring = 0;     ///< From the lowest beam up.
  std::uint32_t time_ns = 0;  ///< Since the sweep's stamp.
};

/// A revolution.
struct VelodyneSweep {
  std::int64_t stamp_ns = 0;  ///< When its first packet was captured, nanoseconds since 1970.
  std::vector<VelodynePoint> points;
  std::size_t sensor = 0;  ///< Of the capture, numbered as their first packets come.
};

/// With the fields x, y, z, intensity, ring and time_ns.
RawCloud raw_cloud_of(const VelodyneSweep& sweep);

/// Whether it is a capture of packets (.pcap, .pcapng), by its first bytes.
bool is_capture(const std::filesystem::path& file);

/// Sweeps in the packets of a VLP-16, HDL-32E or VLP-32C, of single and dual returns (of two that are the
/// same one), by revolution; the first and the last are what there is of them. Packets may come twice or
/// late, or be lost. Several sensors differ by address, port or model, or by azimuths that go on apart from
/// each other. Each sensor gets its own sweeps, ordered by when they end. Azimuths as PCL's grabbers have
/// them: one for each block, between two for the second firing of a VLP-16. Sources: the sensors' manuals
/// (63-9243, 63-9113, 63-9325).
class VelodyneReader {
 public:
  /// With `sensor`, "192.168.1.201:2368", an address and the port that it sends to, the packets of that one
  /// alone. Throws IoError if it is no capture, or has no packet of such a sensor, std::invalid_argument,
  /// naming those that there are, if there is none at that address.
  explicit VelodyneReader(const std::filesystem::path& file, const std::string& sensor = {});
  ~VelodyneReader();
  VelodyneReader(const VelodyneReader&) = delete;
  VelodyneReader& operator=(const VelodyneReader&) = delete;

  std::string_view model() const;  ///< "VLP-16", of the first sensor.

  /// From the beginning again.
  void rewind();

  /// False at the end. Throws IoError where the file cannot be read any more.
  bool next(VelodyneSweep& sweep);

  /// What was not whole so far, and that there are several sensors, a line each.
  std::vector<std::string> remarks() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_bv
