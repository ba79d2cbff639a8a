// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads the sweeps of sensors from captures of their packets.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A LiDAR return, in metres in the sensor's frame, with z up. Members have no initial values, so that
/// decoders can append points before they write them.
struct SensorPoint {
  float x, y, z;
  float intensity;
  std::uint32_t ring;          ///< Number of the beam, or the tag with SensorSweep::has_tag.
  std::uint32_t time_ns;       ///< Nanoseconds since the sweep's stamp.
  std::uint32_t reflectivity;  ///< 0 if the sensor does not measure it (SensorSweep::has_reflectivity).
};

/// Points of a sweep. resize() leaves the new points uninitialised. Write them before reading them.
using SensorPoints = std::vector<SensorPoint, BufferAllocator<SensorPoint>>;

/// The points of one revolution of a sensor, or of 100 ms for sensors without revolution.
struct SensorSweep {
  std::int64_t stamp_ns = 0;  ///< Capture time of the first packet, nanoseconds since 1970.
  SensorPoints points;
  std::size_t sensor = 0;  ///< Number of the sensor, from 0, in the order of the sensors' first packets.
  bool has_ring = true;    ///< Each family of sensors has its own order of rings.
  /// Whether SensorPoint::ring is the tag of a Livox: flags of the point, such as the confidence that it is
  /// no noise. Only without has_ring.
  bool has_tag = false;
  bool has_reflectivity = false;
  std::string_view frame_id;  ///< Default frame of the family's ROS driver, such as "velodyne". A literal.
};

/// Returns the sweep as a cloud with the fields x, y, z, intensity, ring and time_ns, and reflectivity if the
/// sensor measures it. Without SensorSweep::has_ring, there is no field ring; with
/// SensorSweep::has_tag, there is a field tag.
RawCloud raw_cloud_of(const SensorSweep& sweep);

/// Returns whether the first bytes of the file are those of a capture of packets (.pcap, .pcapng).
bool is_capture(const std::filesystem::path& file);

/// Returns the source addresses and destination ports of the sensors in the first 20 000 UDP packets of a
/// capture, such as "192.168.1.201:2368", in ascending order. Throws IoError if the file is not a capture.
std::vector<std::string> sensors_in_capture(const std::filesystem::path& file);

/// Reads the sweeps in a capture. The families of sensors are:
/// - Velodyne (VLP-16, HDL-32E, VLP-32C). Ring 0 is the lowest beam. y is at azimuth 0, x at azimuth 90
///   degrees. The intensity is 0 to 255. Times and azimuths are those at which the laser fired; PCL's
///   grabbers give all lasers of a firing the same azimuth. For each beam of a VLP-32C, the beam's azimuth
///   offset is added. Two identical dual returns give one point. Sources: the sensors' manuals (63-9243,
///   63-9113, 63-9325).
/// - Ouster (OS-0, OS-1, OS-2), with the sensor's metadata in .json files next to the capture. Ring 0 is the
///   highest beam. The intensity is the signal. A frame id is a sweep. Source:
///   the firmware user manual.
/// - Hesai (PandarXT-32, PandarXT-16, PandarXT-32M2X, PandarQT, QT128C2X, Pandar128E3X, OT128, AT128,
///   Pandar64, Pandar40P, Pandar40M). Ring 0 is channel 1. y is at azimuth 0, x at azimuth 90 degrees. The
///   intensity is the reflectivity, 0 to 255. The angles of the channels are in a correction file next to
///   the capture; those of the PandarXT-32 and -16 are known without it. A sweep of an AT128 is the rotation
///   of one of its mirrors. Identical returns give one point. Sources: the sensors' manuals, Hesai's SDK.
/// - Livox (Mid-360, HAP). Sweeps have 100 ms of the sensor's clock and no ring. The intensity is the
///   reflectivity, 0 to 255. The tag of each point is read. Source: the communication protocols of both
///   sensors.
///
/// A sweep is one revolution if the sensor has revolutions, or one passage of a Velodyne's limited field of
/// view. The first and the last sweep may be incomplete.
/// Late packets go to the revolution in which they were measured. Lost packets are tolerated.
///
/// Each sensor has its own sweeps. The sweeps of all sensors come in the order in which they are completed.
/// Sensors are distinguished by source address, destination port and model. If several Velodyne sensors have
/// all three in common, their packets are distinguished by azimuth: the azimuth of each sensor advances
/// steadily.
class PacketReader {
 public:
  /// Opens a capture. If `sensor` is empty, reads the packets of all sensors. Otherwise `sensor` is a source
  /// address and destination port, such as "192.168.1.201:2368", and other packets are skipped. Throws
  /// IoError if the file is not a capture or has no packet that can be decoded. The message then tells which
  /// packets there are, and what is missing to decode them. Throws std::invalid_argument if the capture has
  /// packets of other sensors but not of `sensor`. The message names these other sensors.
  explicit PacketReader(const std::filesystem::path& file, const std::string& sensor = {});
  ~PacketReader();
  PacketReader(const PacketReader&) = delete;
  PacketReader& operator=(const PacketReader&) = delete;

  std::string_view model() const;  ///< Returns the model of the first sensor, such as "VLP-16".

  /// Restarts next() at the beginning of the capture.
  void rewind();

  /// Reads the next sweep. Returns false at the end. Throws IoError if the file can no longer be read. Uses
  /// the memory of `sweep` for later sweeps: a caller that passes the same object again is faster.
  bool next(SensorSweep& sweep);

  /// Returns the warnings found until now, one line each. A warning is about damaged parts of the capture,
  /// about packets that cannot be decoded, or tells that the capture has several sensors.
  std::vector<std::string> warning_lines() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace detail
}  // namespace pcl_bv
