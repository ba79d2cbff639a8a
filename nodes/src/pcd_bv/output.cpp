// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where reports go.

#include "output.h"

#include <utility>

#include "command/standard_streams.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/report/csv.h"

namespace pcl_bv {

std::string render(const Report& report, OutputFormat format) {
  switch (format) {
    case OutputFormat::json:
      return report_json(report);
    case OutputFormat::jsonl:
      return report_json(report) + '\n';
    case OutputFormat::csv:
      return report_csv(report);
    case OutputFormat::text:
      break;
  }
  return report_text(report);
}

ReportWriter::ReportWriter(OutputFormat format, std::optional<std::filesystem::path> file)
    : format_(format), file_(std::move(file)) {}

bool ReportWriter::add(const std::string& rendered) {
  if (format_ == OutputFormat::text && rendered.empty()) return true;
  const bool first = std::exchange(first_, false);
  switch (format_) {
    case OutputFormat::json:
      return write((first ? "[\n" : ",\n") + rendered);
    case OutputFormat::csv:
      return write((first ? report_csv_heading() : "") + rendered);
    case OutputFormat::text:
      return write((first ? "" : "\n") + rendered);
    case OutputFormat::jsonl:
      break;
  }
  return write(rendered);
}

bool ReportWriter::finish() {
  const bool read = format_ != OutputFormat::json || write("\n]\n");
  if (!file_) return read;
  make_folder_of(*file_);
  write_file_atomically(*file_, pending_);
  return true;
}

bool ReportWriter::write(const std::string& text) {
  if (!file_) return write_standard_output(text);
  pending_ += text;
  return true;
}

}  // namespace pcl_bv
