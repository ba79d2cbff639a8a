// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What was found in one frame of a stream, as plain data, and its written form.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pcl_bv/report/report.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// One frame. If `error` is set it was not processed, and only seq, stamp_ns, frame_id, file and error
/// mean anything.
struct FrameReport {
  std::uint64_t seq = 0;
  std::int64_t stamp_ns = 0;
  std::string frame_id;
  std::string file;        ///< Where the cloud comes from; left out if empty.
  std::size_t points = 0;  ///< All points, good or bad.
  Counts counts;
  std::vector<ClusterEntry> clusters;
  std::vector<std::pair<std::string, double>> ms;  ///< Milliseconds by stage, in order.
  std::optional<std::string> error;
};

/// The frame as one JSON object on one line, without the line's end. Numbers as in report_json().
std::string frame_json(const FrameReport& report);

/// The same with these clusters instead of the report's.
std::string frame_json(const FrameReport& report, const ClusterSource& clusters);

}  // namespace pcl_bv
