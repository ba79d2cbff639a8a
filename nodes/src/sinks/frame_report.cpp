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
  for (std::size_t i = 0; i < result.clusters.size(); ++i) {
    TrackedEntry& entry = report.clusters.emplace_back();
    entry.cluster.id = i;
    entry.cluster.points = result.clusters.cluster_size(i);
    if (!result.tracks.empty()) entry.track = result.tracks[i];
    for (std::size_t m = 0; m < result.methods.size(); ++m) {
      VolumeEntry& volume = entry.cluster.volumes.emplace_back();
      volume.method = result.methods[m]->name;
      volume.volume = result.volume(i, m);
      volume.failed = result.results[i * result.methods.size() + m].reason;
    }
  }
  const StageTimes& ms = result.ms;
  report.ms = {{"decode", ms.decode}, {"filter", ms.filter}, {"ground", ms.ground}, {"cluster", ms.cluster},
               {"fit", ms.fit},       {"track", ms.track},   {"total", ms.total}};
  return report;
}

}  // namespace pcl_bv
