// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What a frame's volumes owe to those of the last one.

#include "tracked_volumes.h"

#include "pcl_bv/fitting/fit.h"

namespace pcl_bv {
namespace {

// Tracks do not depend on what volumes are asked for.
Aabb box_of(const FrameResult& result, std::size_t cluster, const PointView& points) {
  for (std::size_t m = 0; m < result.methods.size(); ++m) {
    const Aabb* const box = std::get_if<Aabb>(&result.volume(cluster, m));
    if (box != nullptr && result.has(cluster, m)) return *box;
  }
  Aabb box;
  fit_aabb(points, box);
  return box;
}

}  // namespace

void TrackedVolumes::keep_axes(const Tracker::Assignment& assignment, const TrackConfig& config,
                               std::size_t cluster, const PointView& points, FrameResult& result) {
  const std::size_t methods = methods_.size(), first = assignment.slot * methods;
  if (filters_.capacity() < first + methods) filters_.reserve(4 * (first + methods));
  if (filters_.size() < first + methods) filters_.resize(first + methods);
  const BoxSighting sighting{tracker_.sensor(), assignment.velocity, assignment.moving, assignment.merged,
                             assignment.separated};
  for (std::size_t m = 0; m < methods; ++m) {
    BoxFilter& filter = filters_[first + m];
    if (assignment.fresh) filter = BoxFilter(methods_[m]->upright);
    Obb* const box = std::get_if<Obb>(&result.volumes[cluster * methods + m]);
    if (box == nullptr) continue;
    *box = filter.face(*box, sighting);
    if (config.smooth || config.grow)
      *box = filter.steady(*box, points, sighting, config.smooth, config.grow);
  }
}

void TrackedVolumes::update(const TrackConfig& config, const std::vector<PointView>& clusters,
                            const std::optional<Pose>& pose, FrameResult& result) {
  if (methods_ != result.methods) {
    methods_ = result.methods;
    filters_.clear();
  }
  boxes_.clear();
  for (std::size_t i = 0; i < result.clusters.size(); ++i)
    boxes_.push_back(box_of(result, i, clusters[i]));
  tracker_.update(result.header.stamp_ns, boxes_, config, assignments_, pose);
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    result.tracks.push_back(assignments_[i].track);
    keep_axes(assignments_[i], config, i, clusters[i], result);
  }
}

}  // namespace pcl_bv
