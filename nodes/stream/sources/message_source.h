// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <string>

#include "pcl_bv/nodes/frame_source.h"
#include "stream/middleware.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Creates a source that turns each received message into a frame. The types of `receiver` must be
/// cloud_type_names().
///
/// Points are not copied if they can be read in place (view_points()). A header stamp of 0 is replaced by the
/// time of sending. Latency is measured from the arrival of the message. `name` becomes Frame::file of every
/// frame. Of `options`, only class_field, frame_id and `poses` with times (TUM) are used.
///
/// The source's next() throws FrameError for a message that is not a cloud. make_message_source()
/// throws IoError if the poses cannot be read or have no times, and std::invalid_argument if `receiver` is
/// null.
std::unique_ptr<FrameSource> make_message_source(std::unique_ptr<MessageReceiver> receiver,
                                                 const std::string& name, const ReplayOptions& options = {});

}  // namespace detail
}  // namespace pcl_bv
