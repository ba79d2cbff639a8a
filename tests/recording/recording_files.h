// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>
#include <vector>

#include "pcl_bv/recording/recording.h"
#include "temporary_folder.h"

namespace pcl_bv {
using namespace detail;

/// A message as it is sent, and as it comes back.
struct Sent {
  std::string topic;
  std::int64_t log_time = 0, publish_time = 0;
  std::string data;
  auto operator<=>(const Sent&) const = default;
};
inline std::ostream& operator<<(std::ostream& stream, const Sent& sent) {
  return stream << sent.topic << " at " << sent.log_time << ", " << sent.data.size() << " bytes";
}

inline std::vector<Sent> all_of(RecordingReader& reader) {
  std::vector<Sent> found;
  RecordedMessage message;
  while (reader.next(message)) {
    found.push_back({reader.topics()[message.topic].name, message.log_time_ns, message.publish_time_ns,
                     std::string(reinterpret_cast<const char*>(message.data), message.size)});
  }
  return found;
}

/// Bytes that this process has read so far, by the system's count.
inline std::uint64_t bytes_read() {
  std::ifstream stream("/proc/self/io");
  std::string name;
  std::uint64_t bytes = 0;
  stream >> name >> bytes;
  return bytes;
}

/// A test with a folder that is removed after it.
class RecordingFiles : public testing::Test {
 protected:
  std::filesystem::path at(const std::string& name) const { return folder_ / name; }
  void put(const std::string& name, const std::string& bytes) const {
    std::ofstream(at(name), std::ios::binary) << bytes;
  }
  std::string bytes_of(const std::string& name) const {
    std::ifstream stream(at(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

 private:
  test::TemporaryFolder folder_;
};

}  // namespace pcl_bv
