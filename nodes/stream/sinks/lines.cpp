// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sinks that write lines (jsonl, csv and kitti). Their files can be read while they grow.

#include "line_file.h"
#include "pcl_bv/report/box_labels.h"
#include "pcl_bv/report/csv.h"
#include "sinks.h"

namespace pcl_bv::detail {
namespace {

std::string first_columns(const FrameReport& report) {
  return std::to_string(report.seq) + ',' + std::to_string(report.stamp_ns) + ',';
}

std::string csv_lines(const FrameReport& report, const ClusterSource& clusters) {
  // A lost frame is one line without numbers. The column of the method holds the reason.
  if (report.error)
    return first_columns(report) + ",,," + csv_field("error: " + *report.error) +
           std::string(12 + 7 + 4, ',') + '\n';
  std::string lines;
  for (std::size_t i = 0; i < clusters.count; ++i) {
    const ClusterEntry& cluster = clusters.at(i);
    const std::string track = cluster.track ? std::to_string(cluster.track->id) : "";
    append_csv(first_columns(report) + track, cluster, lines, true);
  }
  return lines;
}

std::string json_line(const FrameReport& report, const ClusterSource& clusters) {
  return frame_json(report, clusters) + '\n';
}

// A lost frame has no line. In KITTI's files this also means that the frame has no object.
std::string kitti_lines(const FrameReport& report, const ClusterSource& clusters) {
  std::string lines;
  if (!report.error)
    write_box_labels({}, clusters, BoxLabelFormat::kitti_tracking, {{}, report.seq},
                     [&](std::string& piece) { lines += piece; });
  return lines;
}

using LinesOfFrame = std::string(const FrameReport&, const ClusterSource&);

class LineSink : public FrameSink {
 public:
  LineSink(const SinkOptions& description, std::string heading, LinesOfFrame* lines)
      : heading_(std::move(heading)), lines_(lines), file_(description.target) {}
  void write(const Frame& frame, const FrameResult& result) override {
    write(lines_(report_without_clusters(frame, result), cluster_source(result)));
  }
  void write_lost(const Frame& frame, const std::string& reason) override {
    write(lines_(report_of_lost(frame, reason), {}));
  }
  void close() override {
    write("");
    file_.close();
  }

 private:
  void write(const std::string& lines) {
    const std::string text = std::exchange(heading_, "") + lines;
    if (!text.empty()) file_.write(text);
  }

  std::string heading_;
  LinesOfFrame* lines_;
  LineFile file_;
};

}  // namespace

std::unique_ptr<FrameSink> open_jsonl(const SinkOptions& description) {
  return std::make_unique<LineSink>(description, "", json_line);
}

std::unique_ptr<FrameSink> open_csv(const SinkOptions& description) {
  return std::make_unique<LineSink>(description, frames_csv_heading(), csv_lines);
}

std::unique_ptr<FrameSink> open_kitti(const SinkOptions& description) {
  return std::make_unique<LineSink>(description, "", kitti_lines);
}

}  // namespace pcl_bv::detail
