// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <array>
#include <cmath>

#include "formatting.h"
#include "pcl_bv/io/number_text.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/report/report.h"
#include "text_sink.h"

namespace pcl_bv {
using namespace detail;
namespace {

constexpr std::size_t n_columns = 12;
constexpr std::size_t method_column = 2;  // the only left-aligned column
using Row = std::array<std::string, n_columns>;

/// Formats a length with `decimals` decimals. If `decimals` is negative, formats four significant digits.
std::string length(double value, int decimals) {
  if (decimals < 0) return general_text(value, 4);
  const bool rounds_to_zero = std::abs(value) * std::pow(10, decimals) < 0.5;
  return fixed_text(rounds_to_zero ? 0 : value, decimals);
}

/// Formats a volume of any magnitude with at least four significant digits.
std::string four_digits(double value) {
  const double magnitude = std::abs(value);
  if (magnitude != 0 && !(magnitude >= 1e-3 && magnitude < 1e7)) return general_text(value, 4);
  const int exponent = value == 0 ? 0 : static_cast<int>(std::floor(std::log10(magnitude)));
  return fixed_text(value, std::max(0, 3 - exponent));
}

/// Returns the number of decimals for the whole table, 0 to 6. The largest size should have five digits, but
/// every centre must have at most 11 characters. Returns -1 if coordinates are too large or too small for
/// fixed notation.
int choose_decimals(const ClusterSource& clusters) {
  double size = 0, magnitude = 0;
  for (std::size_t i = 0; i < clusters.count; ++i) {
    for (const VolumeEntry& entry : clusters.at(i).volumes) {
      if (empty(entry.volume)) continue;
      const Aabb box = aabb(entry.volume);
      size = std::max(size, (box.max() - box.min()).maxCoeff());
      magnitude = std::max({magnitude, box.max().cwiseAbs().maxCoeff(), box.min().cwiseAbs().maxCoeff()});
    }
  }
  if (magnitude == 0) return 1;
  if (magnitude >= 1e7 || magnitude < 1e-3) return -1;
  const auto digits_before_point = [](double v) { return static_cast<int>(std::floor(std::log10(v))) + 1; };
  const int wanted = size > 0 ? 5 - digits_before_point(size) : 6;
  return std::clamp(std::min(wanted, 9 - digits_before_point(magnitude)), 0, 6);
}

Row volume_row(const VolumeEntry& entry, int decimals) {
  Row row;
  row[method_column] = method_label(entry);
  if (entry.outside) row[11] = std::to_string(*entry.outside);
  if (empty(entry.volume)) {
    row[3] = entry.failed.empty() ? "empty" : "failed";
    return row;
  }
  const Eigen::Vector3d middle = center(entry.volume);
  for (int k = 0; k < 3; ++k)
    row[3 + k] = length(middle[k], decimals);
  if (const auto* sphere = std::get_if<Sphere>(&entry.volume)) {
    row[6] = "r ";
    row[6] += length(sphere->radius(), decimals);
  } else {
    const auto* oriented = std::get_if<Obb>(&entry.volume);
    const Aabb box = aabb(entry.volume);
    for (int k = 0; k < 3; ++k)  // an oriented box has its size along its own axes
      row[6 + k] = length(oriented ? 2 * oriented->half_extents()[k] : box.max()[k] - box.min()[k], decimals);
    if (const Obb* const upright = upright_box(entry)) row[9] = length(upright->yaw(), 2);
  }
  row[10] = four_digits(volume(entry.volume));
  return row;
}

/// The rows of a table. They are stored in one text, because a million rows of separate strings take 400 MB.
class Table {
 public:
  void add(const Row& row) {
    for (std::size_t c = 0; c < n_columns; ++c) {
      fields_ += row[c];
      lengths_.push_back(static_cast<std::uint16_t>(row[c].size()));
      width_[c] = std::max(width_[c], row[c].size());
    }
  }

  /// Writes the heading and the rows with aligned columns. Empty columns are left out.
  void write(const Row& heading, const TextSink& take) {
    for (std::size_t c = 0; c < n_columns; ++c)
      width_[c] = std::max(width_[c], heading[c].size());
    std::string text;
    for (std::size_t c = 0; c < n_columns; ++c)
      append(heading[c], c, text);
    end_line(text);
    std::string_view rest = fields_;
    for (std::size_t i = 0; i < lengths_.size(); ++i) {
      append(rest.substr(0, lengths_[i]), i % n_columns, text);
      rest.remove_prefix(lengths_[i]);
      if ((i + 1) % n_columns > 0) continue;
      end_line(text);
      take_if_long(text, take);
    }
    take(text);
  }

 private:
  void append(std::string_view field, std::size_t c, std::string& text) const {
    if (width_[c] == 0) return;
    const std::size_t padding = width_[c] - field.size();
    const bool single_space = c == 4 || c == 5 || (c >= 7 && c <= 9) || (c == 10 && width_[9] > 0);
    text += single_space ? " " : "  ";
    if (c != method_column) text.append(padding, ' ');
    text += field;
    if (c == method_column) text.append(padding, ' ');
  }

  static void end_line(std::string& text) {
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }

  std::string fields_;
  std::vector<std::uint16_t> lengths_;  // lengths of the fields, which are short numbers and method names
  std::array<std::size_t, n_columns> width_{};
};

Row heading_of(bool checked, bool upright, bool other) {
  Row row{"id", "points", "method", "centre x", "y", "z", "size x", "y", "z", "", "volume", "outside"};
  if (!checked) row.back().clear();
  const std::array<std::string, 4> names =
      other ? std::array<std::string, 4>{"length/x", "width/y", "height/z", "yaw"}
            : std::array<std::string, 4>{"length", "width", "height", "yaw"};
  if (upright) std::copy(names.begin(), names.end(), row.begin() + 6);
  return row;
}

void write_table(const ClusterSource& clusters, const TextSink& take) {
  Table table;
  const int decimals = choose_decimals(clusters);
  bool checked = false, upright = false, other = false;
  for (std::size_t i = 0; i < clusters.count; ++i) {
    const ClusterEntry& cluster = clusters.at(i);
    for (const VolumeEntry& entry : cluster.volumes) {
      Row row = volume_row(entry, decimals);
      if (&entry == &cluster.volumes.front()) {
        row[0] = std::to_string(cluster.id);
        row[1] = std::to_string(cluster.points);
      }
      checked = checked || entry.outside;
      const bool has_size = !row[8].empty(), has_yaw = !row[9].empty();
      upright = upright || has_yaw;
      other = other || (has_size && !has_yaw);
      table.add(row);
    }
  }
  table.write(heading_of(checked, upright, other), take);
}

std::string summary_line(const Report& report, std::size_t clusters) {
  std::string text = printable(report.file) + ": ";
  if (report.parts) text += std::to_string(*report.parts) + " inputs, ";
  text += std::to_string(report.points) + " points";
  const auto add = [&](std::size_t n, const char* what) {
    if (n > 0) text += ", " + std::to_string(n) + what;
  };
  add(report.counts.nonfinite, " not finite");
  add(report.counts.range, " out of range");
  add(report.counts.inside, " dropped by regions");
  add(report.counts.ground, " ground");
  add(report.counts.small, " in small clusters");
  add(report.counts.large, " in large clusters");
  add(report.counts.noise, " in no cluster");
  add(report.counts.dropped_class, " of dropped classes");
  add(report.counts.cut, report.counts.cut == 1 ? " cluster cut" : " clusters cut");
  add(report.counts.joined, report.counts.joined == 1 ? " object joined" : " objects joined");
  if (clusters == 0) text += ", no clusters";
  if (report.seconds) {
    text += "; read " + fixed_text(report.seconds->read * 1e3, 1);
    text += ", segment " + fixed_text(report.seconds->segment * 1e3, 1);
    text += ", fit " + fixed_text(report.seconds->fit * 1e3, 1) + " ms";
  }
  if (report.origin) {
    text += "\n  origin";
    for (int axis = 0; axis < 3; ++axis)
      text += ' ' + shortest((*report.origin)[axis]);
    text += " subtracted from coordinates";
  }
  return text + '\n';
}

std::string info_text(const CloudInfo& info) {
  std::string text = "  ";
  for (int axis = 0; axis < 3 && !info.box.empty(); ++axis) {
    text.append(1, "xyz"[axis]).append(" ").append(general_text(info.box.min()[axis], 6));
    text.append(" to ").append(general_text(info.box.max()[axis], 6)).append(", ");
  }
  if (info.spacing) text += "spacing " + general_text(*info.spacing, 3) + ", ";
  if (info.height > 1) text += std::to_string(info.width) + " x " + std::to_string(info.height) + ", ";
  text +=
      std::to_string(info.nonfinite) + " not finite, " + std::to_string(info.zero) + " at 0,0,0\n  fields";
  for (const PointField& field : info.fields) {
    text.append(" ").append(printable(field.name)).append(":").append(1, field.type);
    text.append(std::to_string(8 * field.size));
    if (field.count > 1) text.append("x").append(std::to_string(field.count));
  }
  return text + "\n";
}

}  // namespace

ClusterSource vector_source(const std::vector<ClusterEntry>& clusters) {
  return {clusters.size(), [&clusters](std::size_t i) -> const ClusterEntry& { return clusters[i]; }};
}

void write_report_text(const Report& report, const ClusterSource& clusters, const TextSink& take) {
  if (report.error) return;
  std::string text =
      summary_line(report, clusters.count) + (report.info ? info_text(*report.info) : std::string());
  take(text);
  if (clusters.count > 0) write_table(clusters, take);
}

std::string report_text(const Report& report) {
  std::string all;
  write_report_text(report, vector_source(report.clusters), appended_to(all));
  return all;
}

}  // namespace pcl_bv
