// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Lines, and functions.

#include "pcl_bv/nodes/frame_sink.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "frame_report.h"
#include "line_file.h"
#include "pcl_bv/report/csv.h"
#include "pcl_bv/io/io_error.h"
#include "pcl_bv/report/meshes.h"

namespace pcl_bv {
namespace {

class JsonlSink : public FrameSink {
 public:
  explicit JsonlSink(const std::filesystem::path& file) : file_(file) {}
  void write(const FrameResult& result) override { file_.write(frame_json(to_report(result))); }
  void write_error(const FrameHeader& header, const std::string& reason) override {
    file_.write(frame_json(to_report(header, reason)));
  }
  void close() override { file_.close(); }

 private:
  LineFile file_;
};

class CsvSink : public FrameSink {
 public:
  explicit CsvSink(const std::filesystem::path& file) : file_(file) {}
  void write(const FrameResult& result) override {
    const FrameReport report = to_report(result);
    const std::string frame = std::to_string(report.seq) + ',' + std::to_string(report.stamp_ns) + ',';
    write_heading();
    std::string lines;
    for (const auto& [cluster, track] : report.clusters)
      append_csv(frame + (track ? std::to_string(*track) : ""), cluster, lines);
    if (lines.empty()) return;
    lines.pop_back();  // write() ends the line
    file_.write(std::move(lines));
  }
  void write_error(const FrameHeader&, const std::string&) override {}
  void close() override {
    write_heading();
    file_.close();
  }

 private:
  void write_heading() {
    if (!headed_) file_.write("seq,stamp_ns,track," + std::string(csv_columns));
    headed_ = true;
  }

  LineFile file_;
  bool headed_ = false;
};

class VtpSink : public FrameSink {
 public:
  explicit VtpSink(const std::filesystem::path& folder) : folder_(folder) {
    std::error_code failure;
    std::filesystem::create_directories(folder_, failure);
    if (!std::filesystem::is_directory(folder_))
      throw IoError(folder_.string() + ": cannot be made a folder");
  }
  void write(const FrameResult& result) override {
    std::vector<ClusterEntry> clusters;
    for (TrackedEntry& entry : to_report(result).clusters)
      clusters.push_back(std::move(entry.cluster));
    std::string number = std::to_string(result.header.seq);
    number.insert(0, 6 - std::min<std::size_t>(number.size(), 6), '0');
    const std::string name = "frame" + number + ".vtp";
    write_volumes(folder_ / name, clusters, MeshFormat::vtp);
    if (index_.empty()) first_stamp_ns_ = result.header.stamp_ns;
    index_.push_back({1e-9 * static_cast<double>(result.header.stamp_ns - first_stamp_ns_), name});
  }
  void write_error(const FrameHeader&, const std::string&) override {}
  void close() override { write_pvd(folder_ / "frames.pvd", index_); }

 private:
  std::filesystem::path folder_;
  std::vector<PvdEntry> index_;
  std::int64_t first_stamp_ns_ = 0;
};

class FunctionSink : public FrameSink {
 public:
  explicit FunctionSink(std::function<void(const FrameResult&)> on_result)
      : on_result_(std::move(on_result)) {}
  void write(const FrameResult& result) override { on_result_(result); }
  void write_error(const FrameHeader&, const std::string&) override {}

 private:
  std::function<void(const FrameResult&)> on_result_;
};

}  // namespace

std::unique_ptr<FrameSink> make_jsonl_sink(const std::filesystem::path& file) {
  return std::make_unique<JsonlSink>(file);
}

std::unique_ptr<FrameSink> make_csv_sink(const std::filesystem::path& file) {
  return std::make_unique<CsvSink>(file);
}

std::unique_ptr<FrameSink> make_vtp_sink(const std::filesystem::path& folder) {
  return std::make_unique<VtpSink>(folder);
}

std::unique_ptr<FrameSink> make_sink(std::function<void(const FrameResult&)> on_result) {
  return std::make_unique<FunctionSink>(std::move(on_result));
}

SinkDescription parse_sink(const std::string& description) {
  const std::size_t colon = description.find(':');
  const std::string kind = description.substr(0, colon);
  const std::string place = colon == std::string::npos ? "" : description.substr(colon + 1);
  if (!place.empty() && kind == "jsonl") return {SinkKind::jsonl, place};
  if (!place.empty() && kind == "csv") return {SinkKind::csv, place};
  if (!place.empty() && kind == "vtp") return {SinkKind::vtp, place};
  throw std::invalid_argument("'" + description + "' is not jsonl:FILE, csv:FILE or vtp:FOLDER");
}

std::unique_ptr<FrameSink> make_sink(const SinkDescription& description) {
  switch (description.kind) {
    case SinkKind::jsonl:
      return make_jsonl_sink(description.place);
    case SinkKind::csv:
      return make_csv_sink(description.place);
    case SinkKind::vtp:
      break;
  }
  return make_vtp_sink(description.place);
}

}  // namespace pcl_bv
