// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Assembles the packets of one Velodyne sensor into sweeps.
#pragma once

#include <array>
#include <deque>
#include <string_view>
#include <vector>

#include "packet_file.h"
#include "pcl_bv/recording/packet_reader.h"

namespace pcl_bv::detail {

inline constexpr std::size_t kVelodynePacket = 1206, kVelodyneLasers = 32;

struct VelodyneModel;

/// Returns the model of the sensor that sent the packet, or null if the packet is not of a supported model.
const VelodyneModel* velodyne_model(const Payload& packet);
std::string_view name_of(const VelodyneModel& model);

/// Returns the number of the model in the list of models, and the model with this number.
std::size_t number_of(const VelodyneModel& model);
const VelodyneModel& velodyne_model(std::size_t number);

/// Returns the product id (last byte) of a Velodyne packet, or -1 for other packets.
int velodyne_product(const Payload& packet);

/// One sensor. Its packets come nearly in the order in which they were sent, but some are repeated, late or
/// lost. The revolution of a packet follows from its azimuth and from the azimuth that is predicted from the
/// rotation speed and the capture times. A revolution ends where the azimuth passes 0 in the direction of
/// rotation. A late packet still goes to the previous revolution if the previous sweep has not been passed
/// on.
class VelodyneSensor {
 public:
  explicit VelodyneSensor(const VelodyneModel& model, std::size_t number);

  const VelodyneModel& model() const { return *model_; }

  /// Returns whether the packet's azimuth is within 60 degrees of this sensor's predicted azimuth. Before the
  /// first packet and after a pause of more than 0.3 s, no prediction is possible, and true is returned.
  bool expects(const Payload& packet) const;

  /// Adds a packet's returns to the sweeps. Moves complete sweeps to `whole`.
  void add(const Payload& packet, std::deque<SensorSweep>& whole);

  /// Moves all remaining sweeps to `whole`, complete or not.
  void finish(std::deque<SensorSweep>& whole);

 private:
  SensorSweep empty_sweep() const;
  double rotation_since_last(const Payload& packet) const;
  void update_speed(const Payload& packet, double rotation);
  void begin_revolution(std::int64_t revolution, std::deque<SensorSweep>& whole);
  void add_firing(const Payload& packet, std::size_t block, std::size_t laser, double azimuth, double time,
                  SensorSweep& sweep) const;
  void add_point(const std::byte* at, std::size_t laser, double hundredths, double time,
                 SensorSweep& sweep) const;

  const VelodyneModel* model_;
  std::size_t number_;
  std::array<std::uint32_t, kVelodyneLasers> ring_{};
  std::array<double, kVelodyneLasers> sine_{}, cosine_{};
  // Azimuth offset of each beam plus 360 degrees, so that the sum is not negative. Hundredths of a degree.
  std::array<std::size_t, kVelodyneLasers> azimuth_offset_{};
  bool started_ = false;
  double speed_ = 0;    // hundredths of a degree per nanosecond; negative if azimuths decrease
  double azimuth_ = 0;  // unwrapped azimuth of the newest packet's first block, hundredths of a degree
  // Capture time of the newest packet, and number of the current sweep's revolution.
  std::int64_t last_time_ns_ = 0, revolution_ = 0;
  SensorSweep sweep_, previous_;        // current sweep, and previous sweep, which may get late packets
  unsigned packets_in_revolution_ = 0;  // packets since the beginning of the revolution
};

}  // namespace pcl_bv::detail
