// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/csv.h"

#include <initializer_list>

#include "csv_shape.h"
#include "formatting.h"
#include "text_sink.h"

namespace pcl_bv::detail {
namespace {

// Appends `count` columns, which are empty if `numbers` is null.
void append_columns(std::size_t count, const double* numbers, std::string& text) {
  for (std::size_t i = 0; i < count; ++i) {
    text += ',';
    if (numbers) append_shortest(numbers[i], text);
  }
}

void append_volume(const AnyVolume& any, std::string& text) {
  if (empty(any)) return append_columns(12, nullptr, text);
  const double size = volume(any);
  const CsvShape shape = std::visit([](const auto& s) { return csv_shape(s); }, any);
  append_columns(3, center(any).data(), text);
  append_columns(3, shape.size ? shape.size->data() : nullptr, text);
  append_columns(4, shape.rotation ? shape.rotation->coeffs().data() : nullptr, text);
  append_columns(1, shape.radius ? &*shape.radius : nullptr, text);
  append_columns(1, &size, text);
}

void append_upright(const VolumeEntry& entry, std::string& text) {
  const Obb* const box = upright_box(entry);
  if (box == nullptr) return append_columns(4, nullptr, text);
  append_columns(3, Eigen::Vector3d(2 * box->half_extents()).data(), text);
  text += ',' + shortest(box->yaw());
}

std::string joined(std::initializer_list<std::string_view> columns) {
  std::string line;
  for (const std::string_view& some : columns)
    line.append(line.empty() ? "" : ",").append(some);
  return line + '\n';
}

}  // namespace

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

void append_csv(std::string_view first_columns, const ClusterEntry& cluster, std::string& text,
                bool tracked) {
  for (const VolumeEntry& entry : cluster.volumes) {
    text += first_columns;
    text +=
        ',' + std::to_string(cluster.id) + ',' + std::to_string(cluster.points) + ',' + method_label(entry);
    append_volume(entry.volume, text);
    if (tracked) {
      append_columns(3, cluster.track ? cluster.track->velocity.data() : nullptr, text);
      append_columns(4, cluster.track ? cluster.track->pose.data() : nullptr, text);
    }
    append_upright(entry, text);
    text += '\n';
  }
}

void write_report_csv(const Report& report, const ClusterSource& clusters, const TextSink& take) {
  if (report.error) return;
  const std::string file = csv_field(report.file);
  std::string text;
  for (std::size_t i = 0; i < clusters.count; ++i) {
    append_csv(file, clusters.at(i), text);
    take_if_long(text, take);
  }
  take(text);
}

std::string report_csv(const Report& report) {
  std::string all;
  write_report_csv(report, vector_source(report.clusters), appended_to(all));
  return all;
}

std::string report_csv_heading() {
  return joined({"file", kCsvColumns, kCsvUprightColumns});
}

std::string frames_csv_heading() {
  return joined({"seq,stamp_ns,track", kCsvColumns, kCsvTrackColumns, kCsvTrackedUprightColumns});
}

}  // namespace pcl_bv::detail
