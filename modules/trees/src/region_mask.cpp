// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/trees/region_mask.h"

#include <algorithm>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "convex_region.h"
#include "grown.h"
#include "pcl_bv/kernels/point_source.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv {
namespace {

std::vector<AnyVolume> grown_volumes(const std::vector<Region>& regions) {
  std::vector<AnyVolume> volumes;
  for (const auto& [volume, padding] : regions) {
    if (!(padding >= 0 && padding <= kMaxCoordinate)) {
      std::ostringstream what;
      what << "RegionMask: the padding of a region must be from 0 to 1e100, not " << padding;
      throw std::invalid_argument(what.str());
    }
    if (!empty(volume)) volumes.push_back(grown(volume, padding));
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

}  // namespace

RegionMask::RegionMask(const std::vector<Region>& regions)
    : volumes_(grown_volumes(regions)), tests_(tests_of(volumes_)) {}

bool RegionMask::contains(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  return is_valid({point.x(), point.y(), point.z()}) &&
         std::any_of(volumes_.begin(), volumes_.end(),
                     [&](const AnyVolume& volume) { return pcl_bv::contains(volume, point); });
}

void RegionMask::mark(const PointView& points, std::vector<std::uint8_t>& inside,
                      const Execution& execution) const {
  inside.resize(points.count);
  const std::size_t chunks = chunk_count(points.count);
  // Two chunks are some 50 us of work: less is not worth waking a thread.
  const auto threads = static_cast<unsigned>(std::min<std::size_t>(chunks / 2, 1024));
  for_each_chunk(limit_threads(execution.parallel, std::max(threads, 1U)), chunks, [&](std::size_t chunk) {
    const FloatEnvironment environment;
    const LoadedPoints part = load_chunk(points, chunk);
    const PointView& here = part.view();
    std::uint8_t* const marks = inside.data() + chunk * kChunkPoints;
    region_states(execution.isa, here, tests_, marks);
    for (std::size_t i = 0; i < here.count; ++i) {
      const void* const unclear =
          std::memchr(marks + i, static_cast<int>(RegionState::unclear), here.count - i);
      if (unclear == nullptr) break;
      i = static_cast<std::size_t>(static_cast<const std::uint8_t*>(unclear) - marks);
      const Coordinates p = load_point(here, i);
      marks[i] = contains({p.x, p.y, p.z});
    }
  });
}

}  // namespace pcl_bv
