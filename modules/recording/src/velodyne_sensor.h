// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Assembles the packets of one Velodyne sensor into sweeps.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "packet_file.h"
#include "pcl_bv/recording/packet_reader.h"
#include "velodyne_packet.h"

namespace pcl_bv::detail {

/// One sensor. Its packets come nearly in the order in which they were sent, but some are repeated, late or
/// lost. The revolution of a packet follows from its azimuth and from the azimuth that is predicted from the
/// rotation speed and the sensor's clock, or the capture times if the clock does not fit them. A revolution
/// ends where the azimuth passes 0 in the direction of rotation or, with a limited field of view, where it
/// leaps over the gap. A late packet still goes to the previous revolution if the previous sweep has not been
/// passed on.
class VelodyneSensor {
 public:
  /// Largest difference() of a packet of this sensor: 60 degrees.
  static constexpr double kMaxDifference = 6'000;

  explicit VelodyneSensor(const VelodyneModel& model, std::size_t number);

  /// Returns the difference between the packet's azimuth and this sensor's predicted azimuth, hundredths of a
  /// degree. Returns at most kMaxDifference for a packet whose azimuths follow those of the newest packet.
  /// Before the first packet and after a pause of more than 0.3 s, no prediction is possible, and
  /// kMaxDifference is returned.
  double difference(const Payload& packet) const;

  /// Adds a packet's returns to the sweeps. Moves complete sweeps to `whole`.
  void add(const Payload& packet, std::deque<SensorSweep>& whole);

  /// Moves all remaining sweeps to `whole`, complete or not.
  void finish(std::deque<SensorSweep>& whole);

 private:
  // The rotation from the newest packet's first firing to that of another packet, hundredths of a degree, and
  // how much the azimuth differs from the predicted one.
  struct Rotation {
    double angle = 0, difference = 0;
    bool follows = false;  // whether the azimuths are those after the newest packet
  };
  // The time and azimuth of a firing. The time is relative to the sweep's stamp.
  struct Firing {
    std::size_t block;
    double time_ns, azimuth, advance;
  };

  SensorSweep empty_sweep() const;
  double forward() const { return speed_ < 0 ? -1 : 1; }
  double since_last(const Payload& packet) const;
  std::optional<double> clock_since_last(const Payload& packet) const;
  Rotation rotation_since_last(const Payload& packet, const VelodyneFirings& firings) const;
  void update_speed(const Payload& packet, const VelodyneFirings& firings, double rotation);
  std::int64_t revolution_at(double azimuth) const;
  void note_leap(double from, double to);
  void join_sweeps();
  void begin_revolution(std::int64_t revolution, std::deque<SensorSweep>& whole);
  SensorSweep& sweep_of(std::int64_t revolution, std::deque<SensorSweep>& whole);
  void add_firings(const Payload& packet, const VelodyneFirings& firings, double azimuth, double gap_ns,
                   std::deque<SensorSweep>& whole);
  void add_lasers(const Payload& packet, std::size_t blocks, const Firing& firing, std::size_t first_laser,
                  SensorSweep& sweep) const;
  void add_point(const std::byte* at, std::size_t laser, const Firing& firing, SensorSweep& sweep) const;

  const VelodyneModel* model_;
  std::size_t number_;
  std::array<std::uint32_t, kVelodyneLasers> ring_{};              // of each beam
  std::array<double, kVelodyneLasers> sine_{}, cosine_{};          // of each beam's elevation
  std::array<double, kVelodyneLasers> azimuth_offset_{};           // of each beam
  std::array<double, kVelodyneLasers> laser_ns_{}, laser_part_{};  // time of each laser; the same in blocks
  bool started_ = false;
  double speed_ = 0;               // hundredths of a degree per nanosecond; negative if azimuths decrease
  unsigned measured_speeds_ = 0;   // of which speed_ is the mean
  double first_azimuth_ = 0;       // unwrapped azimuth of the first packet's first firing
  double azimuth_ = 0;             // unwrapped azimuth of the newest packet's first firing
  double newest_total_ = 0;        // rotation within the newest packet
  std::int64_t last_time_ns_ = 0;  // capture time of the newest packet
  std::uint32_t last_us_ = 0;      // sensor's time of the newest packet
  // A revolution begins at this azimuth: 0, or the middle of the gap of a limited field of view.
  double begin_azimuth_ = 0;
  bool has_gap_ = false;                // whether the azimuth has leapt over a gap
  std::int64_t revolution_ = 0;         // number of the current sweep's revolution
  SensorSweep sweep_, previous_;        // current sweep, and previous sweep, which may get late packets
  unsigned packets_in_revolution_ = 0;  // packets since the beginning of the revolution
};

}  // namespace pcl_bv::detail
