// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes reports.

#include "output.h"

#include <utility>

#include "box_format.h"
#include "commands/shared/standard_streams.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/report/csv.h"
#include "pcl_bv/report/tileset.h"

namespace pcl_bv::detail {

namespace {

/// The texts of the output around reports: before the first, between two, and after the last.
struct SurroundingTexts {
  std::string begin, between, end;
};

SurroundingTexts surrounding_texts(OutputFormat format) {
  if (const auto labels = box_label_format(format)) {
    const BoxLabelFile file = box_label_file(*labels);
    return {std::string(file.begin), std::string(file.between), std::string(file.end)};
  }
  switch (format) {
    case OutputFormat::json:
      return {"[\n", ",\n", "\n]\n"};
    case OutputFormat::csv:
      return {report_csv_heading(), "", ""};
    case OutputFormat::text:
      return {"", "\n", ""};
    default:
      return {};
  }
}

}  // namespace

RenderOptions render_options(const Options& options, const std::optional<std::size_t>& frame) {
  return {options.format, {options.object_type, frame}};
}

void render(const Report& report, const ClusterSource& clusters, const RenderOptions& options,
            const TextSink& take) {
  const TextSink not_empty = [&](std::string& piece) {
    if (!piece.empty()) take(piece);
  };
  const bool tiles = options.format == OutputFormat::tiles || options.format == OutputFormat::tile_regions;
  const auto labels = box_label_format(options.format);
  if ((tiles || labels) && report.origin && !report.origin->isZero(0))  // in merged partial results
    throw IoError("was made with --origin, which this format would lose");
  if (labels) return write_box_labels(report, clusters, *labels, options.labels, not_empty);
  std::string line_end = "\n";
  switch (options.format) {
    case OutputFormat::json:
      return write_report_json(report, clusters, not_empty);
    case OutputFormat::jsonl:
      write_report_json(report, clusters, not_empty);
      return take(line_end);
    case OutputFormat::csv:
      return write_report_csv(report, clusters, not_empty);
    case OutputFormat::tiles:
      return write_tileset(report, clusters, TileFrame::cartesian, not_empty);
    case OutputFormat::tile_regions:
      return write_tileset(report, clusters, TileFrame::geographic, not_empty);
    default:
      break;
  }
  write_report_text(report, clusters, not_empty);
}

ReportWriter::ReportWriter(OutputFormat format, std::optional<std::filesystem::path> file)
    : format_(format), file_(std::move(file)) {}

bool ReportWriter::begin() {
  return std::exchange(begun_, true) || write(surrounding_texts(format_).begin);
}

bool ReportWriter::add(std::string&& piece, bool goes_on) {
  if (goes_on) return write(std::move(piece));
  if (!begin()) return false;
  if (piece.empty()) return true;
  const bool separated = !std::exchange(has_piece_, true) || write(surrounding_texts(format_).between);
  return separated && write(std::move(piece));
}

bool ReportWriter::finish() {
  const bool read = begin() && write(surrounding_texts(format_).end);
  if (!file_) return read;
  write_file_atomically(*file_, std::vector<std::string_view>(pending_.begin(), pending_.end()));
  return true;
}

bool ReportWriter::write(std::string&& text) {
  if (text.empty()) return true;
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
