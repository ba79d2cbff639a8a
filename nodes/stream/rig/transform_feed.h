// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Transforms from recordings and from live topics.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "stream/middleware.h"
#include "transforms.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A source of transforms.
class TransformFeed {
 public:
  virtual ~TransformFeed() = default;

  /// Adds transforms to `to`: of a recording, those recorded up to 0.5 s after `recorded_ns`; of a live
  /// topic, those that have come. Invalid transforms are ignored with a warning.
  virtual void read(std::int64_t recorded_ns, Transforms& to) = 0;

  /// Returns the warnings since the last call, one line each.
  virtual std::vector<std::string> take_warnings() = 0;
};

/// A message with transforms.
struct TransformMessage {
  const std::byte* data = nullptr;
  std::size_t size = 0;
  bool ros1 = false;      ///< The encoding is that of ROS 1, not CDR.
  bool odometry = false;  ///< nav_msgs/msg/Odometry, not tf2_msgs/msg/TFMessage.
  bool fixed = false;     ///< The transforms do not change, as those of /tf_static.
};

/// Adds the transforms of a message. Returns a warning if some of them are not rigid transforms, which are
/// ignored, otherwise an empty text. Throws MessageError for bytes that are not such a message.
std::string add_transforms(const TransformMessage& message, Transforms& to);

/// Returns the transforms of a recording: the topics /tf and /tf_static of type tf2_msgs/msg/TFMessage or,
/// without these, those of the first namespace that has them, such as /robot1/tf, with a warning if there are
/// several, and the topic `odometry` of type nav_msgs/msg/Odometry. If `odometry` is empty and there is no
/// topic of changing transforms, the first topic of that type is used. Returns null if the recording has no
/// such topic, and for a capture of packets. Throws as open_named_recording().
std::unique_ptr<TransformFeed> recorded_transforms(const std::string& recording, const std::string& odometry);

/// Returns the topics of type nav_msgs/msg/Odometry of a recording, none for a capture of packets. Throws as
/// open_named_recording().
std::vector<std::string> recorded_odometry_topics(const std::string& recording);

/// Returns the live topics /tf and /tf_static and, if `odometry` is not empty, the topic with this name of
/// type nav_msgs/msg/Odometry. Throws as Middleware::receiver().
std::unique_ptr<TransformFeed> live_transforms(Middleware& middleware, const std::string& odometry);

}  // namespace detail
}  // namespace pcl_bv
