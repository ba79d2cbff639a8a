// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace [[gnu::visibility("default")]] pcl_bv {

/// What messages of a topic are.
struct WrittenTopic {
  std::string name;        ///< "/bv/objects"
  std::string type;        ///< "vision_msgs/msg/Detection3DArray"
  std::string definition;  ///< schema_of(type), for formats that hold it.
  /// "offered_qos_profiles", as rosbag2 writes it, is in all formats, and empty if it is missing here.
  std::map<std::string, std::string> metadata;
};

/// A recording of messages in CDR that grows. Called by one thread.
class RecordingWriter {
 public:
  virtual ~RecordingWriter() = default;

  /// Returns its number for write(). Throws IoError, std::length_error after 65 535 topics.
  virtual std::size_t add_topic(const WrittenTopic& topic) = 0;

  /// Throws std::out_of_range for a topic that is not there, IoError if the message, or some before it,
  /// cannot be written: what is in the file stays whole. Times are nanoseconds since 1970.
  virtual void write(std::size_t topic, std::int64_t log_time_ns, std::int64_t publish_time_ns,
                     const std::byte* data, std::size_t size) = 0;

  /// A whole file in the recording. Throws IoError.
  virtual void attach(const std::string& name, const std::string& media_type, const std::string& content,
                      std::int64_t log_time_ns) = 0;

  /// Ends it; nothing is written afterwards. Throws IoError if it is not all there.
  virtual void close() = 0;
};

}  // namespace pcl_bv
