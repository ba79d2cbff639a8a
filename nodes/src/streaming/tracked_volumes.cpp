// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What a frame's volumes owe to those of the last one.

#include "tracked_volumes.h"

namespace pcl_bv {
namespace {

// Where an object is: all its volumes hold the same points.
Aabb box_of(const FrameResult& result, std::size_t cluster) {
  for (std::size_t m = 0; m < result.methods.size(); ++m) {
    if (const Aabb* box = std::get_if<Aabb>(&result.volume(cluster, m))) return *box;
  }
  return aabb(result.volume(cluster, 0));
}

}  // namespace

void TrackedVolumes::keep_axes(const Tracker::Assignment& assignment, std::size_t cluster,
                               FrameResult& result) {
  if (last_.size() <= assignment.slot) last_.resize(assignment.slot + 1);
  Last& last = last_[assignment.slot];
  if (assignment.fresh || last.methods != result.methods) {
    last.methods = result.methods;
    last.boxes.assign(result.methods.size(), Obb());
  }
  for (std::size_t m = 0; m < result.methods.size(); ++m) {
    Obb* const box = std::get_if<Obb>(&result.volumes[cluster * result.methods.size() + m]);
    if (box == nullptr) continue;
    *box = box->oriented_as(last.boxes[m]);
    last.boxes[m] = *box;
  }
}

void TrackedVolumes::update(const TrackConfig& config, FrameResult& result) {
  boxes_.clear();
  for (std::size_t i = 0; i < result.clusters.size(); ++i)
    boxes_.push_back(box_of(result, i));
  tracker_.update(result.header.stamp_ns, boxes_, config, assignments_);
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    result.tracks.push_back(assignments_[i].id);
    keep_axes(assignments_[i], i, result);
  }
}

}  // namespace pcl_bv
