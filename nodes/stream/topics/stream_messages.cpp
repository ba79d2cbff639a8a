// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Messages about a whole stream and about all points of a frame.

#include <algorithm>
#include <cstring>
#include <utility>

#include "pcl_bv/nodes/topics.h"
#include "pcl_bv/points/point_source.h"
#include "pipeline/config/settings.h"

namespace pcl_bv {
using namespace detail;
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

}  // namespace

std::int64_t MarkerLifetime::next(std::int64_t stamp_ns) {
  const std::int64_t step = stamp_ns - std::exchange(last_stamp_ns_, stamp_ns);
  if (!std::exchange(first_, false) && step > 0) period_ns_ = std::min(step, 2 * kSecond);
  return 3 * period_ns_;
}

void write_labelled_points(const Frame& frame, const FrameResult& result, std::byte* to) {
  const std::vector<std::uint32_t> labels = labels_of(frame, result);
  const std::size_t step = frame.intensity ? 20 : 16;
  const PointView& points = result.cloud_of(frame);
  for (std::size_t chunk = 0; chunk < chunk_count(points.count); ++chunk) {
    const LoadedPoints loaded = load_chunk(points, chunk);
    const PointView& part = loaded.view();
    for (std::size_t i = 0; i < part.count; ++i, to += step) {
      const Coordinates p = load_point(part, i);
      const float xyz[] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
      std::memcpy(to, xyz, sizeof xyz);
      std::memcpy(to + 12, &labels[part.index(i)], 4);
      if (!frame.intensity) continue;
      const float intensity = frame.intensity->at(part.index(i));
      std::memcpy(to + 16, &intensity, 4);
    }
  }
}

bool StreamHealth::record_frame(const Frame& frame, const FrameResult& result) {
  slowest_ms_ = std::max(slowest_ms_, result.ms.total);
  objects_ = result.clusters.size();
  if (warned_config_ != result.config) warning_.clear();
  warned_config_ = result.config;
  for (const std::string& warning : warnings_.take(frame, result))
    warning_ = warning_.empty() ? warning : warning_;
  const std::int64_t since = frame.header.stamp_ns - last_message_ns_;
  if (frames_++ > 0 && since >= 0 && since < kSecond) return false;
  last_message_ns_ = frame.header.stamp_ns;
  return true;
}

std::array<std::pair<const char*, std::string>, 4> StreamHealth::take_values() {
  return {{{"frames", std::to_string(frames_)},
           {"lost", std::to_string(lost_)},
           {"objects", std::to_string(objects_)},
           {"slowest_ms", to_text(std::exchange(slowest_ms_, 0))}}};
}

}  // namespace pcl_bv
