// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/messages/livox.h"

#include <algorithm>
#include <cstring>

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kTimeOffset = 0, kXyzOffset = 4, kReflectivityOffset = 16;
constexpr std::size_t kNumbersOf4Bytes = 4;  // offset_time, x, y and z; the other fields are single bytes

std::optional<FieldView> view_field(const msg::CustomMsg& cloud, std::size_t offset, std::uint32_t size) {
  if (cloud.points.swapped || cloud.points.count == 0) return std::nullopt;
  return FieldView{cloud.points.data + offset, cloud.points.stride, 'U', size};
}

}  // namespace

std::optional<PointView> view_points(const msg::CustomMsg& cloud) {
  const auto& points = cloud.points;
  if (points.count == 0) return PointView();
  if (points.swapped) return std::nullopt;
  PointView view;
  view.data = points.data + kXyzOffset;
  view.stride = points.stride;
  // Not the rest of the stride: the message may end before the padding of the last point.
  view.readable = points.kBytes - kXyzOffset;
  view.count = points.count;
  return view;
}

std::optional<FieldView> view_intensity(const msg::CustomMsg& cloud) {
  return view_field(cloud, kReflectivityOffset, 1);
}

std::optional<FieldView> view_times(const msg::CustomMsg& cloud) {
  return view_field(cloud, kTimeOffset, 4);
}

RawCloud raw_cloud_of(const msg::CustomMsg& cloud) {
  const auto& points = cloud.points;
  RawCloud made;
  made.fields = {
      {"offset_time", 'U', 4, 1, 0},   {"x", 'F', 4, 1, 4},    {"y", 'F', 4, 1, 8},    {"z", 'F', 4, 1, 12},
      {"reflectivity", 'U', 1, 1, 16}, {"tag", 'U', 1, 1, 17}, {"line", 'U', 1, 1, 18}};
  made.point_step = points.kBytes;
  made.width = points.count;
  made.data.resize(made.width * made.point_step);
  for (std::size_t i = 0; i < made.width; ++i) {
    std::byte* const to = made.data.data() + i * made.point_step;
    std::memcpy(to, points.data + i * points.stride, points.kBytes);
    if (!points.swapped) continue;
    for (std::size_t k = 0; k < kNumbersOf4Bytes; ++k)
      std::reverse(to + 4 * k, to + 4 * k + 4);
  }
  return made;
}

}  // namespace pcl_bv::detail
