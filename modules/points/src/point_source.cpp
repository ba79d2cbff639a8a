// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Each thread reuses its buffers, because a fresh buffer of 512 KiB would cost 128 page faults, which take as
// long as reading the points.

#include "pcl_bv/points/point_source.h"

#include <string>
#include <utility>

namespace pcl_bv {
namespace {

// Maximum number of unused buffers that a thread retains. A source that reads from another source uses two
// buffers at a time.
constexpr std::size_t kSpares = 2;

thread_local std::vector<std::vector<std::byte>> spares;

}  // namespace

void LoadedPoints::load(const PointView& points, std::size_t begin, std::size_t count) {
  if (points.indices != nullptr)
    throw std::invalid_argument("LoadedPoints: a view of a PointSource cannot have an index list");
  if (count > kChunkPoints)
    throw std::invalid_argument("LoadedPoints: " + std::to_string(count) +
                                " points of a PointSource are too many; at most " +
                                std::to_string(kChunkPoints) + " are allowed");
  if (!spares.empty()) {
    buffer_ = std::move(spares.back());
    spares.pop_back();
  }
  view_ = points.source->load(points.first + begin, count, buffer_);
  const bool as_requested = view_.source == nullptr && view_.count == count && view_.scalar == points.scalar;
  if (!as_requested || (count > 0 && view_.index(0) != points.first + begin))
    throw std::invalid_argument("PointSource::load() returned other points than requested");
}

void LoadedPoints::return_buffer() {
  if (spares.size() < kSpares) spares.push_back(std::move(buffer_));
}

}  // namespace pcl_bv
