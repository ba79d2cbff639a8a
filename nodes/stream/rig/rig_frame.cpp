// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How a rig makes a frame of the clouds that it has read.

#include <algorithm>
#include <utility>

#include "pcl_bv/io/untrusted_text.h"
#include "rig_source.h"

namespace pcl_bv::detail {

FoundTransform RigSource::find_pose(const Sensor& sensor) {
  if (sensor.input.pose) return {sensor.input.pose, {}, false};
  return poses_.of_sensor(sensor.input.frame, *sensor.next);
}

// Returns the clouds of the next frame with their poses, one element for each sensor.
std::vector<MountedCloud> RigSource::mounted_clouds(std::int64_t stamp_ns) {
  std::vector<MountedCloud> clouds;
  for (Sensor& sensor : sensors_) {
    const bool present = is_member(sensor, stamp_ns);
    if (present) {
      const FoundTransform found = find_pose(sensor);
      if (!found.pose) {
        Frame lost = std::move(*sensor.next);
        sensor.next.reset();
        throw_lost(sensor, std::move(lost), "no pose in " + rig_.frame + ": " + found.problem);
      }
      sensor.pose = *found.pose;
    }
    clouds.push_back({present ? &*sensor.next : nullptr, sensor.input.name, sensor.pose});
  }
  return clouds;
}

// Adds what the merged frame has of the header of a cloud.
void RigSource::add_cloud(Sensor& sensor, Frame& frame) {
  const Frame& cloud = *sensor.next;
  ++sensor.used;
  frame.decode_ms += cloud.decode_ms;
  frame.recorded_ns = std::max(frame.recorded_ns, cloud.recorded_ns);
  const bool earlier = frame.taken == Clock::time_point() || cloud.taken < frame.taken;
  if (earlier) frame.taken = cloud.taken;
  if (!cloud.note.empty())
    frame.note.append(frame.note.empty() ? "" : "; ")
        .append(sensor.input.name)
        .append(": ")
        .append(cloud.note);
  sensor.next.reset();
}

void RigSource::add_pose(Frame& frame) {
  const FoundTransform found = poses_.of_rig(frame.header.stamp_ns, frame.recorded_ns);
  frame.pose = found.pose;
  frame.fixed_frame = rig_.fixed_frame;
  if (found.pose || found.problem.empty()) {
    frames_without_pose_ = 0;
  } else if (is_power_of_ten(++frames_without_pose_)) {
    warnings_.push_back(message_line(std::to_string(frames_without_pose_) + " frames without a pose in " +
                                     rig_.fixed_frame + ": " + found.problem));
  }
}

void RigSource::merge(Frame& frame) {
  const std::int64_t stamp = first_stamp();
  const std::vector<MountedCloud> clouds = mounted_clouds(stamp);
  const auto begin = Clock::now();
  frame = Frame();
  frame.header = {seq_, stamp, rig_.frame, 0};
  frame.file = "rig";
  merger_.merge(clouds, frame);
  for (std::size_t k = 0; k < sensors_.size(); ++k) {
    const bool present = clouds[k].frame != nullptr;
    warn(sensors_[k], sensors_[k].presence.note_frame(present, stamp));
    if (present) add_cloud(sensors_[k], frame);
  }
  add_pose(frame);
  frame.decode_ms += std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  last_stamp_ = stamp;
  ++seq_;
}

}  // namespace pcl_bv::detail
