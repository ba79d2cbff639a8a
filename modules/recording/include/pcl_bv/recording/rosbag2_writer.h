// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <memory>

#include "pcl_bv/recording/recording_writer.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A folder NAME as rosbag2 of Humble writes it: NAME_0.db3 (SQLite) and, with close(), metadata.yaml.
/// Messages are safe from the death of the process some hundredths of a second after write(). attach() makes
/// files beside them.
class Rosbag2Writer final : public RecordingWriter {
 public:
  /// Makes the folder if it is not there; the first message or attachment, or close(), replaces a database
  /// and metadata.yaml of those names. Throws IoError.
  explicit Rosbag2Writer(const std::filesystem::path& folder);

  /// Closes what is open and reports no failure. Without a message, an attachment and close() what was in the
  /// folder stays.
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

}  // namespace pcl_bv
