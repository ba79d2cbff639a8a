// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "loaded_cloud.h"

#include "pcl_bv/points/point_source.h"
#include "shifted_points.h"
#include "tiles.h"

namespace pcl_bv::detail {
namespace {

// Returns the header of a tiled cloud, as if it were one file.
RawCloud header_of(const PointView& points) {
  RawCloud cloud;
  cloud.width = points.count;
  const auto size = static_cast<std::uint32_t>(size_of(points.scalar));
  for (const char* name : {"x", "y", "z"}) {
    cloud.fields.push_back({name, 'F', size, 1, cloud.point_step});
    cloud.point_step += size;
  }
  return cloud;
}

}  // namespace

LoadedCloud::LoadedCloud(const Job& job, bool in_memory, const Execution& execution,
                         const OriginOption& origin, const BoxPredicate& can_skip) {
  if (job.tiles) {
    tiles_ = job.tiles;
    xyz_ = tiles_->xyz();
    cloud_ = header_of(xyz_);
    in_memory = xyz_.count <= kChunkPoints;
    if (in_memory) load_points();
  } else {
    if (!in_memory && !job.error && !job.recording && !is_synth(job.input))
      file_ = CloudFile::open(job.input, job.bin_fields);
    if (!file_) cloud_ = load_cloud(job, execution, can_skip);
    xyz_ = file_ ? file_->xyz() : cloud_.xyz();
  }
  if (!origin.requested) return;
  origin_ = origin.at ? *origin.at : rounded_centre(xyz_, execution);
  shifted_ = std::make_unique<ShiftedPoints>(xyz_, *origin_);
  points_before_shift_ = std::move(points_);
  xyz_ = view_of(*shifted_, xyz_.count, ScalarType::float64);
  if (in_memory) load_points();
}

void LoadedCloud::load_points() {
  points_ = packed_copy(xyz_);
  xyz_ = packed_points(points_.data(), xyz_.scalar, xyz_.count);
}

void LoadedCloud::require_unchanged() const {
  if (file_) file_->require_unchanged();
  if (tiles_) tiles_->require_unchanged();
}

}  // namespace pcl_bv::detail
