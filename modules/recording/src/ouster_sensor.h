// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Assembles the packets of one Ouster sensor into sweeps.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "ouster_metadata.h"
#include "sensor_family.h"

namespace pcl_bv::detail {

/// The geometry of a sensor. A range r of beam i in the column with measurement id m gives the point
/// rotation[m] * (r - beam_distance_mm) * direction[i] + origin[m], in metres in the sensor's frame.
struct OusterGeometry {
  explicit OusterGeometry(const OusterMetadata& metadata);

  struct Column {
    std::array<double, 9> rotation;  // row by row, metres per millimetre
    std::array<double, 3> origin;    // metres
  };
  std::vector<Column> columns;
  std::vector<double> x, y, z;  // direction of each beam in a column with encoder angle 0
  double beam_distance_mm = 0;
  bool upright = false;  // whether the sensor's z axis is parallel to the lidar's
};

/// One sensor. Its sweeps are the frames of the sensor, by the packets' frame id. A packet that comes late
/// goes to its frame, if this is the current or the previous one and has not been passed on. Other late
/// packets are dropped with a warning. A column that is repeated, or whose status tells that it is invalid,
/// is dropped. A column's time is that of the sensor. If a column was measured before the first captured
/// column of its frame, the sweep's stamp moves back to it.
class OusterSensor final : public SweepAssembler {
 public:
  OusterSensor(std::shared_ptr<const OusterMetadata> metadata,
               std::shared_ptr<const OusterGeometry> geometry);

  void add(const Payload& packet, SweepQueue& queue) override;
  void finish(SweepQueue& queue) override;

 private:
  // A sweep that is not complete yet.
  struct Frame {
    bool active = false, stamped = false;
    std::uint16_t id = 0;
    std::uint64_t first_time = 0;  // sensor's time of the sweep's stamp, nanoseconds
    SensorSweep sweep{};
    std::vector<bool> columns{};  // received columns by measurement id
  };

  Frame* frame_of(const Payload& packet, SweepQueue& queue);
  void begin_frame(std::uint16_t id, SweepQueue& queue);
  void pass_on(Frame& frame, SweepQueue& queue);
  void add_column(const std::byte* column, std::int64_t packet_time_ns, Frame& frame);
  template <const OusterProfile& profile>
  void add_returns(const std::byte* channels, const OusterGeometry::Column& column, std::uint32_t time_ns,
                   SensorPoints& points) const;
  template <const OusterProfile& profile, bool upright>
  void add_points(const std::byte* channels, const OusterGeometry::Column& column, std::uint32_t time_ns,
                  SensorPoints& points) const;

  std::shared_ptr<const OusterMetadata> metadata_;
  std::shared_ptr<const OusterGeometry> geometry_;
  std::optional<std::size_t> number_;
  Frame current_, previous_;
  std::int64_t last_time_ns_ = 0;    // capture time of the newest packet
  unsigned packets_in_frame_ = 0;    // packets since the beginning of the current frame
  unsigned late_in_succession_ = 0;  // packets that belong to neither frame
  std::uint64_t late_ = 0;           // dropped packets
  std::uint64_t late_warned_ = 0;
};

}  // namespace pcl_bv::detail
