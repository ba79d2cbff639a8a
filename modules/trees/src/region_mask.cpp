// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/trees/region_mask.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "convex_region.h"
#include "inflated.h"
#include "pcl_bv/kernels/region_states.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/trees/argument_checks.h"
#include "region_runs.h"
#include "vectors.h"
#include "volume_boxes.h"

namespace pcl_bv {
using namespace detail;
namespace {

std::vector<AnyVolume> inflated_volumes(const std::vector<Region>& regions) {
  std::vector<AnyVolume> volumes;
  for (const auto& [volume, padding] : regions) {
    if (!(padding >= 0 && padding <= kMaxCoordinate))
      throw_out_of_range_value("RegionMask: the padding of a region must be from 0 to 1e100", padding);
    if (!empty(volume)) volumes.push_back(inflated(volume, padding));
  }
  return volumes;
}

RegionTests tests_of(const std::vector<AnyVolume>& volumes) {
  std::vector<ConvexRegion> regions;
  regions.reserve(volumes.size());
  for (const AnyVolume& volume : volumes)
    regions.push_back(convex_region(volume));
  return RegionTests(regions);
}

std::shared_ptr<const VolumeBoxes> boxes_of(const std::vector<AnyVolume>& volumes) {
  std::vector<PositionBounds> extents;
  extents.reserve(volumes.size());
  for (const AnyVolume& volume : volumes)
    extents.push_back(extent_of(volume));
  auto boxes = std::make_shared<VolumeBoxes>();
  boxes->build(extents, Serial{});
  return boxes;
}

// Returns the largest useful number of threads, which is one per two chunks. Two chunks take about 50 us, and
// starting a thread for less work gains nothing.
std::size_t threads_for_chunks(std::size_t chunks) {
  return chunks / 2;
}

}  // namespace

struct RegionMask::State {
  std::vector<AnyVolume> volumes;  // inflated, without the empty ones
  RegionTests tests;
  std::shared_ptr<const VolumeBoxes> boxes;  // null for at most kFewRegions volumes

  bool contains(const Eigen::Vector3d& point) const;
  void mark(const PointView& chunk, std::uint8_t* marks, const Execution& execution) const;
};

RegionMask::RegionMask(const std::vector<Region>& regions) {
  const FloatEnvironment environment;
  std::vector<AnyVolume> volumes = inflated_volumes(regions);
  RegionTests tests = tests_of(volumes);
  std::shared_ptr<const VolumeBoxes> boxes;
  if (volumes.size() > kFewRegions) boxes = boxes_of(volumes);
  state_ = std::make_shared<State>(State{std::move(volumes), std::move(tests), std::move(boxes)});
}

std::vector<Aabb> RegionMask::extents() const {
  const FloatEnvironment environment;
  std::vector<Aabb> boxes;
  for (const AnyVolume& volume : state_->volumes) {
    constexpr double most = std::numeric_limits<double>::max();  // a corner of a box is finite
    const PositionBounds extent = extent_of(volume);
    boxes.emplace_back(vector(extent.low).cwiseMax(-most), vector(extent.high).cwiseMin(most));
  }
  return boxes;
}

bool RegionMask::contains(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  return state_->contains(point);
}

bool RegionMask::State::contains(const Eigen::Vector3d& point) const {
  const Coordinates position = coordinates(point);
  if (!is_valid(position)) return false;
  const auto contains_point = [&](const AnyVolume& volume) { return pcl_bv::contains(volume, point); };
  if (!boxes) return std::any_of(volumes.begin(), volumes.end(), contains_point);
  return boxes->visit(boxes->query(position, position),
                      [&](std::uint32_t index) { return contains_point(volumes[index]); });
}

void RegionMask::State::mark(const PointView& points, std::uint8_t* marks, const Execution& execution) const {
  if (boxes) {
    region_states_by_runs(execution.isa, points, tests, *boxes, marks);
  } else {
    region_states(execution.isa, points, tests, marks);
  }
  for (std::size_t i = 0; i < points.count; ++i) {
    const void* const unclear =
        std::memchr(marks + i, static_cast<int>(RegionState::unclear), points.count - i);
    if (unclear == nullptr) break;
    i = static_cast<std::size_t>(static_cast<const std::uint8_t*>(unclear) - marks);
    const Coordinates p = load_point(points, i);
    marks[i] = contains({p.x, p.y, p.z});
  }
}

void RegionMask::mark(const PointView& points, std::vector<std::uint8_t>& inside,
                      const Execution& execution) const {
  inside.resize(points.count);
  const std::size_t chunks = chunk_count(points.count);
  for_each_chunk(limit_threads(execution.parallel, threads_for_chunks(chunks)), chunks,
                 [&](std::size_t chunk) {
                   const LoadedPoints part = load_chunk(points, chunk);
                   state_->mark(part.view(), inside.data() + chunk * kChunkPoints, execution);
                 });
}

}  // namespace pcl_bv
