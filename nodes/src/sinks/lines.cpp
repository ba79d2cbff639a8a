// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Lines that others may read while they grow.

#include "frame_report.h"
#include "line_file.h"
#include "pcl_bv/report/csv.h"
#include "sinks.h"

namespace pcl_bv {
namespace {

class JsonlSink : public FrameSink {
 public:
  explicit JsonlSink(const std::filesystem::path& file) : file_(file) {}
  void write(const Frame& frame, const FrameResult& result) override {
    file_.write(frame_json(to_report(frame, result)) + '\n');
  }
  void write_lost(const Frame& frame, const std::string& reason) override {
    file_.write(frame_json(to_report(frame, reason)) + '\n');
  }
  void close() override { file_.close(); }

 private:
  LineFile file_;
};

class CsvSink : public FrameSink {
 public:
  explicit CsvSink(const std::filesystem::path& file) : file_(file) {}
  void write(const Frame& frame, const FrameResult& result) override {
    std::string lines;
    for (const auto& [cluster, track] : to_report(frame, result).clusters)
      append_csv(first_columns(frame) + (track ? std::to_string(*track) : ""), cluster, lines);
    write(lines);
  }
  // A line of a volume without numbers, whose method is the reason.
  void write_lost(const Frame& frame, const std::string& reason) override {
    write(first_columns(frame) + ",,," + csv_field("error: " + reason) + std::string(12, ',') + '\n');
  }
  void close() override {
    write("");
    file_.close();
  }

 private:
  static std::string first_columns(const Frame& frame) {
    return std::to_string(frame.header.seq) + ',' + std::to_string(frame.header.stamp_ns) + ',';
  }
  void write(const std::string& lines) {
    if (!headed_) file_.write("seq,stamp_ns,track," + std::string(csv_columns) + '\n');
    headed_ = true;
    if (!lines.empty()) file_.write(lines);
  }

  LineFile file_;
  bool headed_ = false;
};

}  // namespace

std::unique_ptr<FrameSink> open_jsonl(const SinkDescription& description) {
  return std::make_unique<JsonlSink>(description.place);
}

std::unique_ptr<FrameSink> open_csv(const SinkDescription& description) {
  return std::make_unique<CsvSink>(description.place);
}

}  // namespace pcl_bv
