// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The table of sensor families. A family recognises its packets and assembles them into sweeps.
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/recording/packet_reader.h"
#include "pcl_bv/recording/recording.h"
#include "udp_payload.h"

namespace pcl_bv::detail {

/// Complete sweeps of all sensors of a capture.
struct SweepQueue {
  std::deque<SensorSweep> whole;
  std::size_t sensors = 0;  ///< Number of sensors found; each new sensor takes it as its number.
  WarningList warnings;
  std::vector<SensorPoints> unused{};  ///< Empty buffers of earlier sweeps.

  /// Keeps the buffer of a sweep that is no longer needed. The operating system clears the pages of new
  /// memory, which takes about as long as to decode the points that fill them.
  void recycle(SensorPoints&& points) {
    constexpr std::size_t max_unused = 4;
    if (points.capacity() == 0 || unused.size() >= max_unused) return;
    points.clear();
    unused.push_back(std::move(points));
  }
  /// Returns an empty buffer with a capacity of at least `capacity` points.
  SensorPoints new_points(std::size_t capacity) {
    SensorPoints points;
    if (!unused.empty()) {
      points = std::move(unused.back());
      unused.pop_back();
    }
    points.reserve(capacity);
    return points;
  }
};

/// Assembles the packets of one model, from one address to one port, into sweeps.
class SweepAssembler {
 public:
  virtual ~SweepAssembler() = default;
  /// Adds a packet that SensorFamily::model_of() has recognised. Moves complete sweeps to `queue`.
  virtual void add(const Payload& packet, SweepQueue& queue) = 0;
  /// Moves all remaining sweeps to `queue`, complete or not.
  virtual void finish(SweepQueue& queue) = 0;
};

/// A family of sensors, opened for one capture.
class SensorFamily {
 public:
  virtual ~SensorFamily() = default;
  /// Returns the number of the model that sent the packet, or nullopt if the packet cannot be decoded.
  virtual std::optional<std::size_t> model_of(const Payload& packet) const = 0;
  virtual std::string_view model_name(std::size_t model) const = 0;
  virtual std::unique_ptr<SweepAssembler> make_assembler(std::size_t model) const = 0;
  /// Returns what a packet is that belongs to the family but cannot be decoded, such as "Velodyne's product
  /// 161". Returns an empty text for packets of other families.
  virtual std::string undecodable(const Payload& packet) const = 0;
  /// Returns what is missing to decode such packets as the last one that undecodable() has named, as the end
  /// of a message. Empty if nothing helps.
  virtual std::string requirement() const { return {}; }
};

/// A row of the table of families.
struct SensorFamilyRow {
  std::string_view models;  ///< For messages, such as "a VLP-16, HDL-32E".
  /// Opens the family for this capture. Never throws for a bad file next to the capture; model_of() then
  /// recognises no packet, and requirement() has the reason.
  std::unique_ptr<SensorFamily> (*open)(const std::filesystem::path& capture);
};

/// All families, in the order in which a packet is offered to them.
const std::vector<SensorFamilyRow>& sensor_families();

std::unique_ptr<SensorFamily> open_velodyne(const std::filesystem::path& capture);
std::unique_ptr<SensorFamily> open_hesai(const std::filesystem::path& capture);
std::unique_ptr<SensorFamily> open_livox(const std::filesystem::path& capture);
std::unique_ptr<SensorFamily> open_ouster(const std::filesystem::path& capture);

}  // namespace pcl_bv::detail
