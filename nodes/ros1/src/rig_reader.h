// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Merges the clouds of several topics for the ROS 1 node.
#pragma once

#include <ros/node_handle.h>

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "live_topics.h"
#include "pcl_bv/nodes/frame_source.h"
#include "pcl_bv/nodes/stream_runner.h"

namespace pcl_bv {
using namespace detail;

/// Merges the clouds of `config.rig`, in its own thread, and pushes them to a runner. Without `rig.sensors`,
/// there is one sensor with the topic `points`. Transforms come from the topics of open_live_rig().
class RigReader {
 public:
  /// `warn` is called with one line for each warning, by any thread. Throws as open_live_rig(). `runner` must
  /// outlive this object.
  RigReader(const ros::NodeHandle& topics, const StreamConfig& config, StreamRunner& runner,
            std::function<void(const std::string&)> warn);
  ~RigReader();
  RigReader(const RigReader&) = delete;
  RigReader& operator=(const RigReader&) = delete;

  /// Subscribes to the clouds or ends these subscriptions. Transforms are always subscribed to, so that they
  /// are known when the first cloud comes.
  void subscribe(bool wanted);

 private:
  void read();

  LiveTopics topics_;
  std::unique_ptr<FrameSource> source_;
  StreamRunner& runner_;
  std::function<void(const std::string&)> warn_;
  std::atomic<bool> wanted_{false}, ended_{false};
  std::thread thread_;
};

}  // namespace pcl_bv
