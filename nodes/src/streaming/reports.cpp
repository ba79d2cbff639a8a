// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "streaming/reports.h"

namespace pcl_bv {

FrameReport report_of_lost(const Frame& frame, const std::string& reason) {
  FrameReport report;
  report.seq = frame.header.seq;
  report.stamp_ns = frame.header.stamp_ns;
  report.frame_id = frame.header.frame_id;
  report.file = frame.file;
  report.error = reason;
  return report;
}

FrameReport report_of(const Frame& frame, const FrameResult& result) {
  FrameReport report = report_of_lost(frame, "");
  report.error.reset();
  report.points = result.points;
  report.counts = result.counts;
  report.clusters = entries_of(result);
  const StageTimes& ms = result.ms;
  report.ms = {{"decode", ms.decode}, {"filter", ms.filter}, {"ground", ms.ground}, {"cluster", ms.cluster},
               {"fit", ms.fit},       {"track", ms.track},   {"total", ms.total}};
  return report;
}

}  // namespace pcl_bv
