// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Assembles the packets of one Hesai sensor into sweeps.
#pragma once

#include <memory>
#include <optional>
#include <unordered_set>
#include <vector>

#include "hesai_geometry.h"
#include "sensor_family.h"

namespace pcl_bv::detail {

/// One sensor. For an AT128, a revolution is the rotation of one mirror. The revolution of a packet follows
/// from its azimuth and from the azimuth that is predicted from the rotation speed and the packets' times. A revolution ends where the azimuth passes 0. A packet
/// that comes late goes to its revolution, if this is the current or the previous one and has not been passed
/// on. Other late packets are dropped with a warning. A repeated packet is dropped. Times are those of the
/// sensor's clock. If a firing was measured before the first captured one of its revolution, the sweep's
/// stamp moves back to it.
class HesaiSensor final : public SweepAssembler {
 public:
  explicit HesaiSensor(std::shared_ptr<const HesaiGeometry> geometry) : geometry_(std::move(geometry)) {}

  void add(const Payload& packet, SweepQueue& queue) override;
  void finish(SweepQueue& queue) override;

 private:
  // A sweep that is not complete yet.
  struct Frame {
    bool active = false, stamped = false;
    std::int64_t revolution = 0;
    std::int64_t first_ns = 0;  // sensor's time of the sweep's stamp, within its second
    SensorSweep sweep{};
    std::unordered_set<std::uint64_t> packets{};  // received packets, by time and azimuth
  };

  double unwrapped_azimuth(const Payload& packet);
  double rotation_in(const Payload& packet, double first) const;
  bool is_too_late(std::int64_t revolution) const;
  Frame& frame_of(std::int64_t revolution, SweepQueue& queue);
  static void pass_on(Frame& frame, SweepQueue& queue);
  void add_firings(const Payload& packet, double azimuth, SweepQueue& queue);
  std::int64_t time_in_sweep(std::int64_t firing_ns, std::int64_t packet_time_ns, Frame& frame) const;
  void add_points(const std::byte* block, std::size_t returns, double azimuth, std::int64_t time_ns,
                  SensorPoints& points);
  template <class Directions>
  void add_returns(const std::byte* block, std::size_t returns, std::int64_t time_ns,
                   const Directions& direction, SensorPoints& points) const;

  std::shared_ptr<const HesaiGeometry> geometry_;
  std::optional<std::size_t> number_;
  Frame current_, previous_;
  bool started_ = false;
  double azimuth_ = 0;               // unwrapped azimuth of the newest packet, hundredths of a degree
  double forward_ = 1;               // 1 if azimuths increase, -1 if they decrease
  std::uint32_t last_us_ = 0;        // sensor's time of the newest packet
  std::int64_t last_time_ns_ = 0;    // capture time of the last packet
  unsigned packets_in_frame_ = 0;    // packets since the beginning of the current revolution
  unsigned late_in_succession_ = 0;  // packets that belong to neither revolution
  std::vector<HesaiDirection> directions_{};  // of an AT128's channels in the current firing
  // Dropped packets, and those of them that a warning has counted.
  std::uint64_t late_ = 0, late_warned_ = 0, excess_ = 0, excess_warned_ = 0;
};

}  // namespace pcl_bv::detail
