// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads recordings: files of time-stamped messages of several topics.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] pcl_bv {

/// A topic of a recording: the messages of one name, type and encoding.
struct RecordedTopic {
  std::string name;
  std::string type;            ///< In ROS 2's spelling, also for ROS 1 bags: "sensor_msgs/msg/PointCloud2".
  std::string encoding;        ///< Encoding of the messages: "cdr", "ros1", or another name from the file.
  std::uint64_t messages = 0;  ///< Number of messages; 0 if the file does not state it.
};

/// A message of a recording.
struct RecordedMessage {
  std::size_t topic = 0;             ///< Index in RecordingReader::topics().
  std::int64_t log_time_ns = 0;      ///< Time of recording, nanoseconds since 1970.
  std::int64_t publish_time_ns = 0;  ///< Time of sending, if the file states it; else log_time_ns.
  const std::byte* data = nullptr;   ///< Valid until the reader's next call; not aligned.
  std::size_t size = 0;              ///< Bytes of data.
};

/// A list of warnings, limited to eleven lines: the first ten, then a line with the number of all others.
class WarningList {
 public:
  /// Adds a warning.
  void add(std::string line);

  /// Adds the warnings of `other` except its first `added` ones, each behind `prefix`. Sets `added` to the
  /// number of all warnings of `other`.
  void append_new(const WarningList& other, std::uint64_t& added, const std::string& prefix = {});

  /// Returns the warnings, at most eleven lines.
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  void add_unlisted(std::uint64_t number);

  std::vector<std::string> lines_;
  std::uint64_t unlisted_ = 0;
};

/// Reads the messages of a recording in sequence. Not thread-safe.
class RecordingReader {
 public:
  virtual ~RecordingReader() = default;

  /// Returns all topics of the recording. If the file has no index (the recorder was killed), they are found
  /// by scanning it.
  virtual const std::vector<RecordedTopic>& topics() const = 0;

  /// Restricts next() to these topics (indices in topics()) and restarts it at the beginning. Initially all
  /// topics are selected. Throws std::out_of_range for an invalid index.
  virtual void select(const std::vector<std::size_t>& topics) = 0;

  /// Reads the next message, in the order of log_time_ns; equal times in the order of the file. The files of
  /// a folder are read one after another. Returns false at the end. Damaged parts are skipped with a warning,
  /// see warning_lines(). Throws IoError if the file cannot be read any more.
  virtual bool next(RecordedMessage& message) = 0;

  /// Returns the warnings about damage so far, without the file's name; at most eleven lines.
  const std::vector<std::string>& warning_lines() const { return warnings_.lines(); }
  /// Returns the same warnings as a list that can be merged into another one.
  const WarningList& warnings() const { return warnings_; }

 protected:
  /// Adds a warning.
  void add_warning(std::string line) { warnings_.add(std::move(line)); }
  /// Adds the new warnings of another list; see WarningList::append_new().
  void add_warnings(const WarningList& other, std::uint64_t& added, const std::string& prefix = {}) {
    warnings_.append_new(other, added, prefix);
  }

 private:
  WarningList warnings_;
};

/// Opens a recording: MCAP, ROS 1 bag, rosbag2's .db3, .db3.zstd or folder. The format is detected as in
/// is_recording(). Throws IoError (io_error.h), without the file's name, if the file cannot be read or its
/// format is unknown.
std::unique_ptr<RecordingReader> open_recording(const std::filesystem::path& file);

/// Returns whether the path is a recording of a known format, by its first bytes. The extension also counts
/// for .zstd, and for a .db3 whose first page is damaged. A folder is a recording if it has rosbag2's
/// metadata.yaml, or .db3 or .mcap files and no clouds. Returns false if the path cannot be read.
bool is_recording(const std::filesystem::path& file);

}  // namespace pcl_bv
