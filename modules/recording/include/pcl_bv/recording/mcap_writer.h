// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pcl_bv/recording/compression.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What messages of a topic are.
struct McapTopic {
  std::string name;                             ///< "/bv/objects"
  std::string type;                             ///< "vision_msgs/msg/Detection3DArray"
  std::string definition;                       ///< schema_of(type), encoding "ros2msg".
  std::map<std::string, std::string> metadata;  ///< Where offered_qos_profiles is missing, it is empty.
};

/// An MCAP file (https://mcap.dev/spec, profile "ros2", messages in CDR) that grows by chunks, each with its index
/// and CRC. What was written before the process ends in any way can be read, but for the chunk it was in. close()
/// adds the summary: schemas, channels, statistics, and an index of chunks and attachments. Called by one thread.
class McapWriter {
 public:
  struct Options {
    Compression compression = Compression::zstd;
    std::size_t chunk_bytes = 1U << 20U;  ///< A chunk ends with the message that makes it so long, uncompressed.
  };

  /// Empties the file. Throws IoError if it cannot be opened.
  explicit McapWriter(const std::filesystem::path& file);
  McapWriter(const std::filesystem::path& file, const Options& options);

  /// Closes what is open, without a word if that fails.
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// Returns its number for write(). Throws std::length_error after 65 535 topics.
  std::size_t add_topic(const McapTopic& topic);

  /// Throws std::out_of_range for a topic that is not there, IoError if a chunk cannot be written: those before
  /// are in the file. Times are nanoseconds since 1970; negative ones become 0, MCAP has no others.
  void write(std::size_t topic, std::int64_t log_time_ns, std::int64_t publish_time_ns, const std::byte* data,
             std::size_t size);

  /// A whole file in the recording. Throws IoError.
  void attach(const std::string& name, const std::string& media_type, const std::string& content,
              std::int64_t log_time_ns);

  /// Ends the file; nothing is written afterwards. Throws IoError if it is not all there.
  void close();

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_bv
