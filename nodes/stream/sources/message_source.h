// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <string>

#include "pcl_bv/nodes/frame_source.h"
#include "stream/middleware.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Each message (sensor_msgs/msg/PointCloud2) as a frame, without a copy of its points where they can be read in it. What
/// is no such message is a FrameError. A stamp of 0 becomes the time of sending. A frame's latency counts from when it
/// came. Of the options it takes class_field, frame_id and poses by time. `name` is the file of its frames. Throws
/// IoError for poses that cannot be read or that are not by time, std::invalid_argument without a receiver.
std::unique_ptr<FrameSource> make_message_source(std::unique_ptr<MessageReceiver> receiver, const std::string& name,
                                                 const ReplayOptions& options = {});

}  // namespace pcl_bv
