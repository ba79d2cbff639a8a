// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A copy, since what is written may outlive the frame.

#include "frame_report.h"

namespace pcl_bv {

FrameReport to_report(const Frame& frame, const std::string& error) {
  FrameReport report;
  report.seq = frame.header.seq;
  report.stamp_ns = frame.header.stamp_ns;
  report.frame_id = frame.header.frame_id;
  report.file = frame.file;
  report.error = error;
  return report;
}

FrameReport to_report(const Frame& frame, const FrameResult& result) {
  FrameReport report = to_report(frame, "");
  report.error.reset();
  report.points = result.points;
  report.counts = result.counts;
  std::vector<ClusterEntry> entries = entries_of(result);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    report.clusters.push_back(
        {std::move(entries[i]), result.tracks.empty() ? std::nullopt : result.tracks[i]});
  }
  const StageTimes& ms = result.ms;
  report.ms = {{"decode", ms.decode}, {"filter", ms.filter}, {"ground", ms.ground}, {"cluster", ms.cluster},
               {"fit", ms.fit},       {"track", ms.track},   {"total", ms.total}};
  return report;
}

}  // namespace pcl_bv
