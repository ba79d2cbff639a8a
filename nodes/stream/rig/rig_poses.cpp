// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "rig_poses.h"

#include <optional>
#include <utility>

namespace pcl_bv::detail {

RigPoses::RigPoses(std::vector<std::unique_ptr<TransformFeed>> feeds, Transforms known, const RigConfig& rig,
                   const ReplayOptions& options)
    : frame_(rig.frame),
      fixed_frame_(rig.fixed_frame),
      feeds_(std::move(feeds)),
      transforms_(std::move(known)) {
  if (!options.poses.empty()) file_ = Poses(options.poses, std::nullopt);
}

void RigPoses::read_feeds(std::int64_t recorded_ns) {
  // Clouds of files have no time of recording. To a feed, 0 would be the beginning of its recording.
  if (recorded_ns != 0) recorded_ns_ = recorded_ns;
  for (const std::unique_ptr<TransformFeed>& feed : feeds_)
    feed->read(recorded_ns_, transforms_);
}

FoundTransform RigPoses::of_sensor(const std::string& frame, const Frame& cloud) {
  read_feeds(cloud.recorded_ns);
  const std::string& source = frame.empty() ? cloud.header.frame_id : frame;
  if (source.empty())
    return {{}, "its clouds have no frame id; give one as `frame` of the sensor in rig.sensors", false};
  return transforms_.find(frame_, source, cloud.header.stamp_ns);
}

FoundTransform RigPoses::of_rig(std::int64_t stamp_ns, std::int64_t recorded_ns) {
  if (const std::optional<Pose> pose = file_.at(0, stamp_ns)) return {pose, {}, false};
  if (fixed_frame_.empty()) return {};
  read_feeds(recorded_ns);
  return transforms_.find(fixed_frame_, frame_, stamp_ns);
}

std::vector<std::string> RigPoses::take_warnings() {
  std::vector<std::string> all;
  for (const std::unique_ptr<TransformFeed>& feed : feeds_)
    for (std::string& line : feed->take_warnings())
      all.push_back(std::move(line));
  for (std::string& line : transforms_.take_warnings())
    all.push_back(std::move(line));
  return all;
}

}  // namespace pcl_bv::detail
