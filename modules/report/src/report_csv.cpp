// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/csv.h"

#include <array>

#include "csv_shape.h"
#include "shortest.h"

namespace pcl_bv {
namespace {

/// Numbers of columns after the method.
enum Column : std::size_t {
  center_x = 0,
  size_x = 3,
  rotation_x = 6,
  radius = 10,
  volume_column = 11,
  column_count = 12
};
using Columns = std::array<std::string, column_count>;

template <typename Vector>
void set(Columns& columns, std::size_t first, const Vector& vector) {
  for (const double number : vector)
    columns[first++] = shortest(number);
}

Columns columns_of(const AnyVolume& any) {
  Columns columns;
  if (empty(any)) return columns;
  const CsvShape shape = std::visit([](const auto& s) { return csv_shape(s); }, any);
  set(columns, center_x, center(any));
  if (shape.size) set(columns, size_x, *shape.size);
  if (shape.rotation) set(columns, rotation_x, shape.rotation->coeffs());
  if (shape.radius) columns[radius] = shortest(*shape.radius);
  columns[volume_column] = shortest(volume(any));
  return columns;
}

}  // namespace

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

void append_csv(std::string_view first_columns, const ClusterEntry& cluster, std::string& text) {
  for (const VolumeEntry& entry : cluster.volumes) {
    text += first_columns;
    text += ',' + std::to_string(cluster.id) + ',' + std::to_string(cluster.points) + ',' + entry.method;
    for (const std::string& column : columns_of(entry.volume))
      text += ',' + column;
    text += '\n';
  }
}

std::string report_csv(const Report& report) {
  std::string text;
  if (report.error) return text;
  const std::string file = csv_field(report.file);
  for (const ClusterEntry& cluster : report.clusters)
    append_csv(file, cluster, text);
  return text;
}

std::string report_csv_heading() {
  return "file," + std::string(csv_columns) + '\n';
}

}  // namespace pcl_bv
