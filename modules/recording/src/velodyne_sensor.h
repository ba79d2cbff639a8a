// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One sensor's packets, put together to sweeps.
#pragma once

#include <array>
#include <deque>
#include <string_view>
#include <vector>

#include "packet_file.h"
#include "pcl_bv/recording/velodyne.h"

namespace pcl_bv {

inline constexpr std::size_t kVelodynePacket = 1206, kVelodyneLasers = 32;

struct VelodyneModel;

/// nullptr for what is no packet of a sensor that we know.
const VelodyneModel* velodyne_model(const Payload& packet);
std::string_view name_of(const VelodyneModel& model);

/// The last byte of a packet that begins as those of a Velodyne do, else -1.
int velodyne_product(const Payload& packet);

/// Packets come in nearly the order in which they were sent: some twice, some too late, some not at all.
/// Packets are assigned by the azimuth predicted from the rotation speed and the capture times. A turn ends
/// where azimuths pass 0 in the direction of rotation; a packet from before that goes to its own turn.
class VelodyneSensor {
 public:
  explicit VelodyneSensor(const VelodyneModel& model, std::size_t number);

  const VelodyneModel& model() const { return *model_; }

  /// Whether the packet's azimuth is where this sensor should be at its time, to 60 degrees. True before the
  /// first packet, and when nothing came for so long that nobody knows.
  bool expects(const Payload& packet) const;

  /// Adds a packet's returns; sweeps that are complete go to `whole`.
  void add(const Payload& packet, std::deque<VelodyneSweep>& whole);

  /// What there is of the last sweeps.
  void finish(std::deque<VelodyneSweep>& whole);

 private:
  double ahead(const Payload& packet) const;
  void learn_speed(const Payload& packet, double way);
  void begin_turn(std::int64_t turn, std::deque<VelodyneSweep>& whole);
  void add_firing(const Payload& packet, std::size_t block, std::size_t laser, double azimuth, double time,
                  VelodyneSweep& sweep) const;
  void add_point(const std::byte* at, std::size_t laser, double hundredths, double time,
                 VelodyneSweep& sweep) const;

  const VelodyneModel* model_;
  std::size_t number_;
  std::array<std::uint32_t, kVelodyneLasers> ring_{};
  std::array<double, kVelodyneLasers> sine_{}, cosine_{};
  std::array<std::size_t, kVelodyneLasers> aside_{};  // hundredths of a degree, a turn more
  bool started_ = false;
  double speed_ = 0;  // hundredths of a degree in a nanosecond; negative the other way round
  double place_ = 0;  // of the newest packet's first block, hundredths since the beginning: turns add up
  std::int64_t last_time_ns_ = 0, turn_ = 0;
  VelodyneSweep sweep_, previous_;  // the latter waits for packets that come late
  unsigned since_turn_ = 0;         // packets
};

}  // namespace pcl_bv
