// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cmath>

#include "pcl_bv/report/frame_report.h"
#include "report_tree.h"

namespace pcl_bv {

std::string frame_json(const FrameReport& report) {
  Json json{{"schema", 1}, {"seq", report.seq}, {"stamp_ns", report.stamp_ns}, {"frame_id", report.frame_id}};
  if (report.error) {
    json["error"] = *report.error;
    return to_text(json);
  }
  json["points"] = report.points;
  json["counts"] = counts_json(report.counts);
  json["clusters"] = Json::array();
  for (const auto& [cluster, track] : report.clusters) {
    json["clusters"].push_back({{"id", cluster.id},
                                {"track", track ? Json(*track) : Json()},
                                {"points", cluster.points},
                                {"volumes", volumes_json(cluster)}});
  }
  json["ms"] = Json::object();
  for (const auto& [stage, milliseconds] : report.ms)
    json["ms"][stage] = std::round(milliseconds * 1e3) / 1e3;
  return to_text(json);
}

}  // namespace pcl_bv
