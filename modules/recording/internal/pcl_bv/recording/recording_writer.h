// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A topic to be written.
struct WrittenTopic {
  std::string name;        ///< Name, such as "/bv/objects".
  std::string type;        ///< Type, such as "vision_msgs/msg/Detection3DArray".
  std::string definition;  ///< schema_of(type), for formats that store it.
  /// Further properties by name. MCAP stores all of them. rosbag2 stores only "offered_qos_profiles", which
  /// is a text in rosbag2's YAML form. If this property is missing, an empty text is stored for it.
  std::map<std::string, std::string> metadata;
};

/// Writes a recording of messages in CDR. Not thread-safe.
class RecordingWriter {
 public:
  virtual ~RecordingWriter() = default;

  /// Adds a topic and returns its index for write(). Throws IoError if the topic cannot be written. Throws
  /// std::length_error if there are 65535 topics already.
  virtual std::size_t add_topic(const WrittenTopic& topic) = 0;

  /// Writes a message. Times are nanoseconds since 1970. Throws std::out_of_range for an unknown topic.
  /// Throws IoError if this message or earlier buffered messages cannot be written. The file stays readable.
  virtual void write(std::size_t topic, std::int64_t log_time_ns, std::int64_t publish_time_ns,
                     const std::byte* data, std::size_t size) = 0;

  /// Adds a file with this name and content to the recording. Throws IoError if the file cannot be written.
  virtual void attach(const std::string& name, const std::string& media_type, const std::string& content,
                      std::int64_t log_time_ns) = 0;

  /// Finishes the recording. Nothing can be written afterwards. Throws IoError if the recording could not be
  /// written completely.
  virtual void close() = 0;
};

}  // namespace detail
}  // namespace pcl_bv
