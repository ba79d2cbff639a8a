// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The result of one frame of a stream as plain data, and as JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pcl_bv/report/report.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// The result of one frame. If `error` is set, the frame was not processed, and only seq, stamp_ns, frame_id,
/// file and error are valid.
struct FrameReport {
  std::uint64_t seq = 0;      ///< Number of the frame in the stream.
  std::int64_t stamp_ns = 0;  ///< Time stamp, nanoseconds.
  std::string frame_id;       ///< Name of the coordinate frame.
  std::string file;           ///< Path of the cloud's file; left out of the JSON if empty.
  std::size_t points = 0;     ///< Number of all points, valid or not.
  Counts counts;              ///< Numbers of dropped points by reason.
  std::vector<ClusterEntry> clusters;
  std::vector<std::pair<std::string, double>> ms;  ///< Milliseconds of each stage, in the stages' order.
  std::optional<std::string> error;                ///< Reason of the failure, if any.
};

/// Returns the frame as one JSON object on one line, without a line end. Numbers are as in report_json().
/// `track` is null for a cluster without a track.
std::string frame_json(const FrameReport& report);

/// Like the other overload, with the clusters of `clusters` instead of report.clusters.
std::string frame_json(const FrameReport& report, const ClusterSource& clusters);

}  // namespace pcl_bv
