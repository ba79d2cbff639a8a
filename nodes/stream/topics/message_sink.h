// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pcl_bv/nodes/frame_sink.h"
#include "stream/middleware.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Which messages a sink sends.
struct MessageTopics {
  std::string prefix = "/bv";  ///< Text before "/objects", "/markers", "/scene", "/points" and "/frames".
  bool points = false;         ///< Labelled clouds on "/points".
  bool scene = true;           ///< foxglove_msgs/msg/SceneUpdate on "/scene".
  /// Each frame, also if it was lost, as a line of the sink `jsonl` on "/frames", for viewers.
  bool frames = false;
  bool poses = true;  ///< Poses of the sensor in "map", if known, on "/tf".
  std::vector<std::string> adapters;  ///< Names of adapter_kinds() whose messages are sent, too.
};

/// Creates a sink that sends these messages:
/// - objects (Detection3DArray of vision_msgs 4) and markers (MarkerArray of ROS 2 Humble and later);
/// - the messages enabled in `topics`;
/// - "/diagnostics", once per second of stream time.
///
/// A frame without a frame_id gets "lidar", because viewers need a frame_id. Throws std::invalid_argument if
/// `carrier` is null, and for an unknown adapter.
std::unique_ptr<FrameSink> make_message_sink(std::unique_ptr<MessageSender> carrier,
                                             const MessageTopics& topics = {});

}  // namespace detail
}  // namespace pcl_bv
