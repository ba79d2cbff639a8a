// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <string>

#include "pcl_bv/nodes/frame_sink.h"
#include "stream/middleware.h"

namespace [[gnu::visibility("default")]] pcl_bv {

struct MessageTopics {
  std::string prefix = "/bv";  ///< Before "/objects", "/markers", "/scene", "/points" and "/frames".
  bool points = false;         ///< The clouds with labels.
  bool scene = true;           ///< foxglove_msgs/msg/SceneUpdate.
  bool frames = false;         ///< Each frame, lost ones too, as a line of the sink `jsonl`, on "/frames"; for viewers.
  bool poses = true;           ///< Of the sensor in "map", where they are known, on "/tf".
};

/// Sends objects (vision_msgs 4 Detection3DArray), markers (MarkerArray of Humble and later), what `topics` asks for, and
/// "/diagnostics" once a second of the stream's time. A frame without a frame_id is in "lidar", since viewers need one.
std::unique_ptr<FrameSink> make_message_sink(std::unique_ptr<MessageCarrier> carrier, const MessageTopics& topics = {});

}  // namespace pcl_bv
