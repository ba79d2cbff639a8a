// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/synth/rural_road_truth.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>

namespace pcl_bv::detail {
namespace {

void append(std::string& text, double value) {
  std::array<char, 32> digits{};
  // Write -0.0 as 0.
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value == 0 ? 0.0 : value).ptr;
  text.append(digits.data(), end);
}

template <std::size_t count>
void append(std::string& text, const std::array<double, count>& values, std::string_view between) {
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += between;
    append(text, values[i]);
  }
}

template <std::size_t count>
void append_field(std::string& text, std::string_view name, const std::array<double, count>& values) {
  text.append(",\"").append(name).append("\":[");
  append(text, values, ",");
  text += ']';
}

void append_field(std::string& text, std::string_view name, double value) {
  text.append(",\"").append(name).append("\":");
  append(text, value);
}

void append_object(std::string& text, const RuralRoadObject& object, std::size_t points) {
  text.append("{\"id\":").append(std::to_string(object.id));
  text.append(",\"class\":\"").append(name_of(object.kind)).append("\"");
  append_field(text, "center", object.center);
  text += ",\"axes\":[";
  for (std::size_t axis = 0; axis < 3; ++axis) {
    text += axis > 0 ? ",[" : "[";
    append(text, object.axes[axis], ",");
    text += ']';
  }
  text += ']';
  append_field(text, "yaw", std::atan2(object.axes[0][1], object.axes[0][0]));
  const auto& half = object.half_extents;
  append_field(text, "size", std::array<double, 3>{2 * half[0], 2 * half[1], 2 * half[2]});
  append_field(text, "velocity", object.velocity);
  append_field(text, "yaw_rate", object.yaw_rate);
  text.append(",\"points\":").append(std::to_string(points)).append("}");
}

}  // namespace

std::string pose_line(const RuralRoadFrame& frame) {
  std::string text;
  append(text, frame.pose, " ");
  return text + '\n';
}

std::string truth_line(const RuralRoadFrame& frame, std::size_t number) {
  std::map<std::uint32_t, std::size_t> points;
  for (const std::uint32_t id : frame.cloud.object)
    if (id != 0) ++points[id];
  const auto stamp = std::llround(1e9 * street_frame_seconds * static_cast<double>(number));
  std::string text = "{\"seq\":" + std::to_string(number) + ",\"stamp_ns\":" + std::to_string(stamp);
  append_field(text, "pose", frame.pose);
  text += ",\"objects\":[";
  bool first = true;
  for (const RuralRoadObject& object : frame.objects) {
    if (!first) text += ',';
    first = false;
    const auto seen = points.find(object.id);
    append_object(text, object, seen == points.end() ? 0 : seen->second);
  }
  return text + "]}\n";
}

}  // namespace pcl_bv::detail
