// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Time-stamped messages of several topics in one file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] pcl_bv {

/// Messages of one name and type.
struct RecordedTopic {
  std::string name;
  std::string type;      ///< In the spelling of ROS 2, also of ROS 1's bags: "sensor_msgs/msg/PointCloud2".
  std::string encoding;  ///< Of the messages: "cdr", "ros1", or what else the file says.
  std::uint64_t messages = 0;  ///< Their number; 0 if the file does not say.
};

struct RecordedMessage {
  std::size_t topic = 0;             ///< Its place in RecordingReader::topics().
  std::int64_t log_time_ns = 0;      ///< When it was recorded, nanoseconds since 1970.
  std::int64_t publish_time_ns = 0;  ///< When it was sent, if the file says; else the same.
  const std::byte* data = nullptr;   ///< Good until the next call; of any alignment.
  std::size_t size = 0;
};

/// Lines about what was damaged: the first ten, and in a last one the number of the others.
class WarningList {
 public:
  void add(std::string line);

  /// Adds those of `other` beyond its first `added`, and sets `added` to their number.
  void add_new_of(const WarningList& other, std::uint64_t& added, const std::string& prefix = {});

  const std::vector<std::string>& lines() const { return lines_; }

 private:
  void add_unlisted(std::uint64_t number);

  std::vector<std::string> lines_;
  std::uint64_t unlisted_ = 0;
};

/// A recording that is read once, from its beginning to its end. Called by one thread.
class RecordingReader {
 public:
  virtual ~RecordingReader() = default;

  /// All of the file. Where it has no index (a recorder that was killed): those found so far.
  virtual const std::vector<RecordedTopic>& topics() const = 0;

  /// next() gives messages of these topics only, from the beginning on; at first all. Throws
  /// std::out_of_range for one that is not there.
  virtual void select(const std::vector<std::size_t>& topics) = 0;

  /// In the order of log_time_ns, equal ones in that of the file; false at the end. What is damaged is passed
  /// over, with a line in remarks(). Throws IoError where the file cannot be read any more.
  virtual bool next(RecordedMessage& message) = 0;

  /// What was damaged so far, a line each, without the file's name; at most eleven lines.
  const std::vector<std::string>& remarks() const { return warnings_.lines(); }
  const WarningList& warnings() const { return warnings_; }

 protected:
  void remark(std::string line) { warnings_.add(std::move(line)); }
  void remark(const WarningList& other, std::uint64_t& added, const std::string& prefix = {}) {
    warnings_.add_new_of(other, added, prefix);
  }

 private:
  WarningList warnings_;
};

/// Opens it by what is in it, not by its name. Throws IoError (io_error.h), without the file's name, if it
/// cannot be read or is no recording that we know.
std::unique_ptr<RecordingReader> open_recording(const std::filesystem::path& file);

/// Whether it is one, by its first bytes; a folder by its metadata.yaml. False for what cannot be read.
bool is_recording(const std::filesystem::path& file);

}  // namespace pcl_bv
