// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "footprints.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/messages/finite.h"
#include "pcl_bv/nodes/topics.h"

namespace pcl_bv::detail {
namespace {

// Returns the prism of a cluster or, if none is requested, that of its box.
Prism footprint_of(const FrameResult& result, std::size_t cluster) {
  for (std::size_t m = 0; m < result.methods.size(); ++m) {
    const auto* const prism = std::get_if<Prism>(&result.volume(cluster, m));
    if (prism != nullptr && result.is_requested(cluster, m) && !prism->empty()) return *prism;
  }
  const VolumeShape box = box_of(result, cluster);
  if (box.kind != VolumeShape::Kind::cube) return {};
  const auto& [x, y, z, w] = box.orientation;
  const Eigen::Matrix3d axes = Eigen::Quaterniond(w, x, y, z).toRotationMatrix();
  const Eigen::Map<const Eigen::Vector3d> centre(box.position.data()), size(box.size.data());
  Eigen::Matrix<double, 3, 8> corners;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d side(k & 1, k >> 1 & 1, k >> 2);
    corners.col(k) = centre + axes * (side.array() - 0.5).matrix().cwiseProduct(size);
  }
  return fit_prism(PointView::of(corners.data(), 24, 8), result.config->ground.up).volume;
}

}  // namespace

std::vector<Footprint> footprints_of(const Frame& frame, const FrameResult& result) {
  std::vector<Footprint> all;
  for (std::size_t i = 0; i < result.clusters.size(); ++i) {
    Footprint footprint;
    fill_footprint(frame, footprint_of(result, i), footprint.message);
    if (footprint.message.polygon.points.empty() || !is_finite(footprint.message)) continue;
    footprint.distance = std::numeric_limits<double>::infinity();
    for (const msg::Point32& p : footprint.message.polygon.points)
      footprint.distance = std::min(footprint.distance, Eigen::Vector3d(p.x, p.y, p.z).norm());
    const TrackEntry* const track = result.track_of(i);
    footprint.id = track != nullptr ? track->id : -1 - static_cast<std::int64_t>(i);
    all.push_back(std::move(footprint));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Footprint& a, const Footprint& b) { return a.distance > b.distance; });
  return all;
}

}  // namespace pcl_bv::detail
