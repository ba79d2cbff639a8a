// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <memory>

#include "pcl_bv/recording/recording_writer.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Writes a folder NAME as rosbag2 of Humble does, with NAME_0.db3 (SQLite) and metadata.yaml. close() writes
/// metadata.yaml. Messages are committed by close() and by the first write() that comes 50 ms or more after
/// the first uncommitted message. Committed messages survive a crash of the process. attach() writes a file
/// into the folder.
class Rosbag2Writer final : public RecordingWriter {
 public:
  /// Creates the folder if it does not exist. An existing database and metadata.yaml in the folder are
  /// replaced only at the first message or attachment, or at close(). Throws IoError if the folder cannot be
  /// created or written.
  explicit Rosbag2Writer(const std::filesystem::path& folder);

  /// Calls close() if a message or attachment was written, and ignores errors of close(). Otherwise the
  /// folder's content stays unchanged.
  ~Rosbag2Writer() override;
  Rosbag2Writer(const Rosbag2Writer&) = delete;
  Rosbag2Writer& operator=(const Rosbag2Writer&) = delete;

  std::size_t add_topic(const WrittenTopic& topic) override;
  void write(std::size_t topic, std::int64_t log_time_ns, std::int64_t publish_time_ns, const std::byte* data,
             std::size_t size) override;
  void attach(const std::string& name, const std::string& media_type, const std::string& content,
              std::int64_t log_time_ns) override;
  void close() override;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace detail
}  // namespace pcl_bv
