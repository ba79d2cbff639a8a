// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads recordings, which are files of time-stamped messages of several topics.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace [[gnu::visibility("default")]] pcl_bv {

/// A topic of a recording, which is all messages of the same name, type and encoding.
struct RecordedTopic {
  std::string name;
  std::string type;            ///< Always in ROS 2's spelling, such as "sensor_msgs/msg/PointCloud2".
  std::string encoding;        ///< Encoding of the messages: "cdr", "ros1", or another name from the file.
  std::uint64_t messages = 0;  ///< Number of messages; 0 if the file does not state it.
};

/// A message of a recording.
struct RecordedMessage {
  std::size_t topic = 0;             ///< Index in RecordingReader::topics().
  std::int64_t log_time_ns = 0;      ///< Time of recording, nanoseconds since 1970.
  std::int64_t publish_time_ns = 0;  ///< Time of sending; log_time_ns if the file does not state it.
  const std::byte* data = nullptr;   ///< Not aligned. Valid until the next call of the reader.
  std::size_t size = 0;              ///< Bytes of data.
};

/// A list of warnings with at most eleven lines. These are the first ten warnings, then one line with the
/// number of further warnings.
class WarningList {
 public:
  /// Adds a warning.
  void add(std::string line);

  /// Adds those warnings of `other` that earlier calls have not added, with `prefix` before each. `added` is
  /// the number of warnings added until now. It must be 0 at the first call, and each call updates it.
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

  /// Returns all topics of the recording. If the file has no index, for example because the recorder was
  /// killed, the topics are found by scanning the file.
  virtual const std::vector<RecordedTopic>& topics() const = 0;

  /// Restricts next() to these topics (indices in topics()) and restarts next() at the beginning of the
  /// recording. Initially all topics are selected. Throws std::out_of_range for an invalid index.
  virtual void select(const std::vector<std::size_t>& topics) = 0;

  /// Reads the next message. Returns false at the end. The messages of a file come in the order of
  /// log_time_ns. Messages with equal times come in the order of the file. The files of a folder are read one
  /// after another. Parts that are damaged or can no longer be read are skipped with a warning (see
  /// warning_lines()).
  virtual bool next(RecordedMessage& message) = 0;

  /// Returns the warnings found until now, at most eleven lines. The lines do not name the recording itself.
  /// If the recording is a folder, a line about one of its files names this file.
  const std::vector<std::string>& warning_lines() const { return warnings_.lines(); }
  /// Returns the same warnings as a list that WarningList::append_new() can add to another list.
  const WarningList& warnings() const { return warnings_; }

 protected:
  /// Adds a warning.
  void add_warning(std::string line) { warnings_.add(std::move(line)); }
  /// Adds the new warnings of another list (see WarningList::append_new()).
  void add_warnings(const WarningList& other, std::uint64_t& added, const std::string& prefix = {}) {
    warnings_.append_new(other, added, prefix);
  }

 private:
  WarningList warnings_;
};

/// Opens a recording, which is an MCAP file, a ROS 1 bag, or a rosbag2 folder or file (.db3, .db3.zstd,
/// .mcap.zstd). The format is detected as in is_recording(). Throws IoError if the file cannot be read or its
/// format is unknown. The message does not name the file.
std::unique_ptr<RecordingReader> open_recording(const std::filesystem::path& file);

/// Returns whether the path is a recording of a known format. Returns false if the path cannot be read.
///
/// The first bytes of a file decide, with two exceptions. A compressed file must also have the extension
/// .zstd. A file with the extension .db3 is a recording unless it is empty. The first bytes of a .db3 file
/// may be damaged and do not matter.
///
/// A folder is a recording if it has rosbag2's metadata.yaml. Without metadata.yaml, it is a recording if it
/// has .db3 or .mcap files (compressed or not) and no clouds.
bool is_recording(const std::filesystem::path& file);

}  // namespace pcl_bv
