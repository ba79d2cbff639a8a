// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Assembles the packets of one Livox sensor into sweeps.
#pragma once

#include <optional>
#include <unordered_set>

#include "livox_packet.h"
#include "sensor_family.h"

namespace pcl_bv::detail {

/// One sensor. A Livox has no revolution. A sweep has the packets whose first point was measured in the same
/// 100 ms of the sensor's clock; the clock at the beginning is a multiple of 100 ms, as in Livox' driver. A
/// packet that comes late goes to its sweep, if this is the current or the previous one and has not been
/// passed on. Other late packets are dropped with a warning. A repeated packet is dropped. If a packet was
/// measured before the first captured packet of its sweep, the sweep's stamp moves back to it.
class LivoxSensor final : public SweepAssembler {
 public:
  void add(const Payload& packet, SweepQueue& queue) override;
  void finish(SweepQueue& queue) override;

 private:
  // A sweep that is not complete yet.
  struct Frame {
    bool active = false;
    std::uint64_t number = 0;      // its time by the sensor's clock, in units of 100 ms
    std::uint64_t first_time = 0;  // sensor's time of the sweep's stamp, nanoseconds
    SensorSweep sweep{};
    std::unordered_set<std::uint64_t> packets{};  // times of the received packets
  };

  bool is_damaged(const Payload& packet, const LivoxPacket& header);
  Frame* frame_of(const Payload& packet, const LivoxPacket& header, SweepQueue& queue);
  void begin_frame(std::uint64_t number, const Payload& packet, const LivoxPacket& header, SweepQueue& queue);
  static void pass_on(Frame& frame, SweepQueue& queue);
  static void add_points(const std::byte* points, const LivoxPacket& header, Frame& frame);

  std::optional<std::size_t> number_;
  Frame current_, previous_;
  bool has_checksums_ = false;       // whether a packet had a correct checksum
  std::int64_t last_time_ns_ = 0;    // capture time of the newest packet
  unsigned packets_in_frame_ = 0;    // packets since the beginning of the current frame
  unsigned late_in_succession_ = 0;  // packets that belong to neither frame
  // Dropped packets, and those of them that a warning has counted.
  std::uint64_t late_ = 0, late_warned_ = 0, damaged_ = 0, damaged_warned_ = 0, excess_ = 0,
                excess_warned_ = 0;
};

}  // namespace pcl_bv::detail
