// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A source of frames that have the clouds of several sensors.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "merged_cloud.h"
#include "pcl_bv/nodes/frame_source.h"
#include "rig_poses.h"
#include "sensor_clocks.h"
#include "sensor_presence.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A sensor of a rig and the source of its clouds.
struct SensorInput {
  std::unique_ptr<FrameSource> source;
  std::string name;            ///< For messages: the topic.
  std::string frame;           ///< Frame id of the sensor; if empty, that of its clouds.
  std::optional<Pose> pose{};  ///< In the frame of the rig; if not set, from transforms.
};

/// The parts of a rig. open_rig() makes them from names.
struct RigInputs {
  std::vector<SensorInput> sensors;
  std::vector<std::unique_ptr<TransformFeed>> feeds;
  Transforms transforms;  ///< Those that are known from the beginning.
};

/// See open_rig().
class RigSource final : public FrameSource {
 public:
  /// Frames have Frame::seconds if `options.point_times`. Throws std::invalid_argument if `rig` is not valid,
  /// and IoError if `options.poses` cannot be read.
  RigSource(RigInputs inputs, const RigConfig& rig, const ReplayOptions& options);

  Next next(Frame& frame, std::chrono::milliseconds timeout) override;
  std::vector<std::string> take_warnings() override;

 private:
  using Clock = std::chrono::steady_clock;

  struct Sensor {
    SensorInput input;
    std::optional<Frame> next;         // its next cloud
    Clock::time_point arrival{};       // of `next`
    std::optional<std::int64_t> last;  // stamp of the cloud read last
    Pose pose = Pose::Identity();      // in the frame of the rig, when it was last known
    SensorPresence presence;
    bool ended = false;
    std::uint64_t clouds = 0, used = 0, late = 0, unmatched = 0;
    std::string problem;  // of its last cloud that was lost
  };

  void read_cloud(Sensor& sensor);
  void read_clouds(Clock::time_point until);
  bool is_late(const Sensor& sensor, const Frame& cloud) const;
  void drop_late(Sensor& sensor, const Frame& cloud);
  void drop_unmatched();
  void drop_jumped(Sensor& sensor);
  void begin_repetition();
  void warn(const Sensor& sensor, const std::string& what);
  void check_clock(Sensor& sensor, const Frame& cloud);
  [[noreturn]] void throw_lost(Sensor& sensor, Frame cloud, const std::string& problem);
  [[noreturn]] void throw_unreadable(Sensor& sensor, const FrameError& error);
  bool all_ended() const;
  bool is_complete() const;
  std::int64_t first_stamp() const;
  bool is_member(const Sensor& sensor, std::int64_t stamp_ns) const;
  FoundTransform find_pose(const Sensor& sensor);
  bool has_transforms();
  std::vector<MountedCloud> mounted_clouds(std::int64_t stamp_ns);
  void merge(Frame& frame);
  void add_cloud(Sensor& sensor, Frame& frame);
  void add_pose(Frame& frame);
  void end();

  RigConfig rig_;
  std::vector<Sensor> sensors_;
  RigPoses poses_;
  CloudMerger merger_;
  bool own_stamps_;  // stamps are those of the sensors
  std::int64_t sync_ns_;
  std::optional<std::int64_t> last_stamp_;  // of the last frame
  std::uint64_t seq_ = 0;
  bool live_ = false;  // a source once had no cloud and had not ended
  SensorClocks clocks_;
  std::uint64_t frames_without_pose_ = 0;  // successive ones
  std::vector<std::string> warnings_;
};

}  // namespace detail
}  // namespace pcl_bv
