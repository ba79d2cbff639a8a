// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "object_parts.h"

#include <algorithm>
#include <boost/crc.hpp>
#include <cstring>
#include <vector>

#include "pcl_bv/points/point_source.h"
#include "pcl_bv/report/object_file.h"
#include "stored/run_writer.h"

namespace pcl_bv::detail {
namespace {

std::uint32_t crc(std::string_view bytes) {
  boost::crc_32_type sum;
  sum.process_bytes(bytes.data(), bytes.size());
  return sum.checksum();
}

template <typename T>
std::string_view bytes_of(const T* items, std::size_t count) {
  return {reinterpret_cast<const char*>(items), count * sizeof(T)};
}

// A share in parts. Sizes in the preamble that do not fit are those of what there is.
struct Parts {
  ObjectFilePreamble preamble{};
  std::string records, texts, header, cloud;
  std::vector<ShareRun> runs;
  std::vector<ShareComponent> components;
  std::vector<ObjectText> begins;
};

class Input {
 public:
  explicit Input(std::string_view bytes) : left_(bytes) {}
  bool has_share() const { return left_.size() >= sizeof(ObjectFilePreamble); }

  Parts take(bool has_headers) {
    Parts parts;
    std::memcpy(&parts.preamble, left_.data(), sizeof parts.preamble);
    left_.remove_prefix(sizeof parts.preamble);
    parts.records = take_bytes(parts.preamble.record_bytes);
    parts.texts = take_bytes(parts.preamble.text_bytes);
    if (has_headers) {
      parts.header = take_bytes(parts.preamble.header_bytes);
      parts.cloud = take_bytes(parts.preamble.cloud_bytes);
    }
    take_items(parts.preamble.runs, parts.runs);
    take_items(parts.preamble.components, parts.components);
    take_items(parts.preamble.components + 1, parts.begins);
    take_bytes(sizeof(std::uint32_t));
    return parts;
  }

 private:
  std::string take_bytes(std::uint64_t count) {
    const std::string_view taken = left_.substr(0, std::min<std::uint64_t>(count, left_.size()));
    left_.remove_prefix(taken.size());
    return std::string(taken);
  }
  template <typename T>
  void take_items(std::uint64_t count, std::vector<T>& items) {
    const std::string taken =
        take_bytes(std::min<std::uint64_t>(count, left_.size() / sizeof(T)) * sizeof(T));
    items.resize(taken.size() / sizeof(T));
    if (!items.empty()) std::memcpy(items.data(), taken.data(), taken.size());
  }

  std::string_view left_;
};

// Lets runs have all records, and components that there are.
void repair_runs(ScalarType scalar, const ObjectChoices& choices, Parts& parts) {
  const std::size_t step = share_record_bytes(scalar);
  const BrickGrid grid = grid_of_runs(fuzzed_options(choices), scalar);
  std::uint64_t left = parts.records.size() / step, at = 0;
  if (!choices.own_components)
    for (ShareComponent& component : parts.components)
      component.points = 0;
  for (ShareRun& run : parts.runs) {
    run.points = std::clamp<std::uint64_t>(run.points, 1, std::max<std::uint64_t>(left, 1));
    if (run.points > left) break;
    const auto* const first = reinterpret_cast<const std::byte*>(parts.records.data()) + at * step;
    if (!choices.own_cells) {
      PointView view = packed_points(first, scalar, 1);
      const Coordinates point = load_point(view, 0);
      if (is_valid(point)) run.cell = grid.cell_of(grid.scaled(point)).key;
    }
    if (run.component >= parts.components.size()) run.component = ShareRun::kNoise;
    if (run.component != ShareRun::kNoise && !choices.own_components)
      parts.components[run.component].points += run.points;
    run.check_sum = run_check_sum(first, run.points * step);
    left -= run.points;
    at += run.points;
  }
  std::erase_if(parts.runs,
                [n = std::uint64_t{0}, at](const ShareRun& run) mutable { return (n += run.points) > at; });
  parts.records.resize(at * step);
}

void repair_texts(Parts& parts) {
  parts.begins.resize(parts.components.size() + 1);
  std::uint64_t at = 0;
  for (ObjectText& text : parts.begins)
    at = text.begin =
        std::clamp<std::uint64_t>(text.begin, at, std::max<std::uint64_t>(at, parts.texts.size()));
  parts.begins.front().begin = 0;
  parts.begins.back().begin = parts.texts.size();
  for (std::size_t c = 0; c + 1 < parts.begins.size(); ++c) {
    const std::uint64_t begin = parts.begins[c].begin;
    parts.begins[c].check_sum =
        crc(std::string_view(parts.texts).substr(begin, parts.begins[c + 1].begin - begin));
  }
}

// Writes a header, and the points of the share with a number among all shares.
void make_headers(ScalarType scalar, std::size_t number, Parts& parts) {
  parts.header = std::string(R"({"scalar":")") + (scalar == ScalarType::float32 ? "float32" : "float64") +
                 R"(","nonfinite":0,"clusters":"c","volumes":"v"})" + '\n';
  PartialFile cloud;
  cloud.inputs = 1;
  cloud.cloud_points = 1000;
  cloud.shares = {{number % 9 * 100, number % 9 * 100 + 100}};
  parts.cloud = partial_file_content(cloud);
}

std::string joined(Parts& parts) {
  std::memcpy(parts.preamble.format, "pcl_bv objects 1\n\0\0\0\0\0\0\0", sizeof parts.preamble.format);
  parts.preamble.record_bytes = parts.records.size();
  parts.preamble.text_bytes = parts.texts.size();
  parts.preamble.header_bytes = parts.header.size();
  parts.preamble.cloud_bytes = parts.cloud.size();
  parts.preamble.runs = parts.runs.size();
  parts.preamble.components = parts.components.size();
  parts.begins.resize(parts.components.size() + 1);
  const std::string_view preamble = bytes_of(&parts.preamble, 1);
  std::string index = parts.header + parts.cloud;
  index.append(bytes_of(parts.runs.data(), parts.runs.size()));
  index.append(bytes_of(parts.components.data(), parts.components.size()));
  index.append(bytes_of(parts.begins.data(), parts.begins.size()));
  const std::uint32_t sum = crc(std::string(preamble) + index);
  return std::string(preamble) + parts.records + parts.texts + index + std::string(bytes_of(&sum, 1));
}

}  // namespace

ClusterOptions fuzzed_options(const ObjectChoices& choices) {
  ClusterOptions options;
  options.tolerance = 0.5F;
  options.min_size = 2;
  options.max_size = 40;
  options.min_points = choices.min_points;
  return options;
}

std::string repaired_objects(std::string_view content, const ObjectChoices& choices) {
  if (choices.repair == ObjectChoices::kNothing) return std::string(content);
  const bool all = choices.repair != ObjectChoices::kCheckSums;
  Input input(content);
  std::string file;
  for (std::size_t number = 0; input.has_share(); ++number) {
    Parts parts = input.take(!all);
    if (all) {
      repair_runs(choices.scalar, choices, parts);
      repair_texts(parts);
      make_headers(choices.scalar, number, parts);
    }
    file += joined(parts);
  }
  return file;
}

std::string without_headers(std::string_view file) {
  Input input(file);
  std::string shares;
  while (input.has_share()) {
    Parts parts = input.take(true);
    parts.header.clear();
    parts.cloud.clear();
    shares += joined(parts);
  }
  return shares;
}

}  // namespace pcl_bv::detail
