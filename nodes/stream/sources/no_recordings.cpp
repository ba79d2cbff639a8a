// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Used instead of recorded.cpp, packets.cpp and recording_sink.cpp in builds without the component
// `recording`.

#include <algorithm>
#include <array>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/read_cloud.h"
#include "sources.h"
#include "stream/sinks/sinks.h"

namespace pcl_bv {

std::vector<SourceKind> recording_kinds() {
  return {};
}

std::vector<SinkKind> recording_sinks() {
  return {};
}

void check_recording_content(const std::filesystem::path& file) {
  constexpr std::array names{".bag", ".mcap", ".db3", ".pcap", ".pcapng"};
  if (std::find(names.begin(), names.end(), lower_case_extension(file)) != names.end())
    throw IoError("is a recording, which this build cannot read: it lacks the component recording");
}

}  // namespace pcl_bv
