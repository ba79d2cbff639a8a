// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where reports go.

#include "output.h"

#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/csv.h"
#include "pcl_bv/io/io_error.h"

namespace pcl_bv {

bool write_standard_output(std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(STDOUT_FILENO, text.data(), text.size());
    if (n >= 0) {
      text.remove_prefix(static_cast<std::size_t>(n));
    } else if (errno == EPIPE) {
      return false;
    } else if (errno != EINTR) {
      throw IoError(std::generic_category().message(errno));
    }
  }
  return true;
}

ReportWriter::ReportWriter(OutputFormat format, std::optional<std::filesystem::path> file)
    : format_(format), file_(std::move(file)) {}

bool ReportWriter::add(const Report& report) {
  const bool first = std::exchange(first_, false);
  switch (format_) {
    case OutputFormat::json:
      return write((first ? "[\n" : ",\n") + report_json(report));
    case OutputFormat::jsonl:
      return write(report_json(report) + '\n');
    case OutputFormat::csv:
      return write((first ? report_csv_heading() : "") + report_csv(report));
    case OutputFormat::text:
      break;
  }
  if (report.error) {
    first_ = first;
    return true;
  }
  return write((first ? "" : "\n") + report_text(report));
}

void ReportWriter::finish() {
  if (format_ == OutputFormat::json) write("\n]\n");
  if (file_) write_file_atomically(*file_, pending_);
}

bool ReportWriter::write(const std::string& text) {
  if (!file_) return write_standard_output(text);
  pending_ += text;
  return true;
}

}  // namespace pcl_bv
