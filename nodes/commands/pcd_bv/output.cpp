// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes reports.

#include "output.h"

#include <utility>

#include "commands/shared/standard_streams.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/report/csv.h"

namespace pcl_bv::detail {

void render(const Report& report, const ClusterSource& clusters, OutputFormat format, const TextSink& take) {
  const TextSink not_empty = [&](std::string& piece) {
    if (!piece.empty()) take(piece);
  };
  std::string line_end = "\n";
  switch (format) {
    case OutputFormat::json:
      return write_report_json(report, clusters, not_empty);
    case OutputFormat::jsonl:
      write_report_json(report, clusters, not_empty);
      return take(line_end);
    case OutputFormat::csv:
      return write_report_csv(report, clusters, not_empty);
    case OutputFormat::text:
      break;
  }
  write_report_text(report, clusters, not_empty);
}

ReportWriter::ReportWriter(OutputFormat format, std::optional<std::filesystem::path> file)
    : format_(format), file_(std::move(file)) {}

bool ReportWriter::add(std::string&& piece, bool goes_on) {
  if (goes_on) return write(std::move(piece));
  if (format_ == OutputFormat::text && piece.empty()) return true;
  const bool first = std::exchange(first_, false);
  switch (format_) {
    case OutputFormat::json:
      return write(first ? "[\n" : ",\n") && write(std::move(piece));
    case OutputFormat::csv:
      return write(first ? report_csv_heading() : "") && write(std::move(piece));
    case OutputFormat::text:
      return write(first ? "" : "\n") && write(std::move(piece));
    case OutputFormat::jsonl:
      break;
  }
  return write(std::move(piece));
}

bool ReportWriter::finish() {
  const bool read = format_ != OutputFormat::json || write("\n]\n");
  if (!file_) return read;
  create_parent_folders(*file_);
  write_file_atomically(*file_, std::vector<std::string_view>(pending_.begin(), pending_.end()));
  return true;
}

bool ReportWriter::write(std::string&& text) {
  if (!file_) return write_standard_output(text);
  constexpr std::size_t worth_a_piece = 1 << 16;  // bytes; the last piece is filled up to this size
  if (!pending_.empty() && pending_.back().size() + text.size() < worth_a_piece) {
    pending_.back() += text;
  } else if (!text.empty()) {
    pending_.push_back(std::move(text));
  }
  return true;
}

}  // namespace pcl_bv::detail
