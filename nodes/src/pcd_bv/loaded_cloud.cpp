// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Generated clouds are always held.

#include "loaded_cloud.h"

#include <cstring>

#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/kernels/chunks.h"

namespace pcl_bv {
namespace {

/// The points of a view, which are not of an index list, less an origin: differences, rounded to double.
class ShiftedPoints final : public PointSource {
 public:
  ShiftedPoints(const PointView& points, const Eigen::Vector3d& origin) : points_(points), origin_(origin) {}

  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override {
    const LoadedPoints part(points_, first, count);
    constexpr std::size_t step = 3 * sizeof(double);
    if (buffer.size() < count * step) buffer.resize(count * step);
    for (std::size_t i = 0; i < count; ++i) {
      const Coordinates p = load_point(part.view(), i);
      const double shifted[3] = {p.x - origin_.x(), p.y - origin_.y(), p.z - origin_.z()};
      std::memcpy(buffer.data() + i * step, shifted, step);
    }
    return packed_points(buffer.data(), ScalarType::float64, count, first);
  }

 private:
  PointView points_;
  Eigen::Vector3d origin_;
};

/// The middle of the points' box in whole numbers; 0 without a valid point.
Eigen::Vector3d whole_origin(const PointView& points, const ParallelPolicy& policy) {
  Aabb box;
  fit_aabb(points, box, {policy});
  return box.empty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(box.center().array().round());
}

/// All points of a source, three doubles each.
std::vector<double> load_all(const PointView& points) {
  std::vector<double> all(3 * points.count);
  for (std::size_t chunk = 0; chunk < chunk_count(points.count); ++chunk) {
    const LoadedPoints part = load_chunk(points, chunk);
    std::memcpy(all.data() + 3 * chunk * kChunkPoints, part.view().data,
                part.view().count * 3 * sizeof(double));
  }
  return all;
}

}  // namespace

LoadedCloud::LoadedCloud(const Job& job, bool hold, const ParallelPolicy& policy,
                         const OriginOption& origin) {
  if (!hold && !job.error && !job.recording && !is_synth(job.input)) file_ = CloudFile::open(job.input, job.bin_fields);
  if (!file_) held_ = load_cloud(job, policy);
  xyz_ = file_ ? file_->xyz() : held_.xyz();
  if (!origin.asked) return;
  origin_ = origin.at ? *origin.at : whole_origin(xyz_, policy);
  shifted_ = std::make_unique<ShiftedPoints>(xyz_, *origin_);
  xyz_ = view_of(*shifted_, xyz_.count, ScalarType::float64);
  if (!hold) return;
  near_ = load_all(xyz_);
  xyz_ = PointView::of(near_.data(), 3 * sizeof(double), near_.size() / 3);
}

}  // namespace pcl_bv
