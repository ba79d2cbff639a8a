// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/frame_picture.h"

#include <utility>

#include "stages/subset.h"

namespace pcl_bv {

Picture picture_of(const Frame& frame, const FrameResult& result, const std::vector<std::uint32_t>& labels) {
  const bool clusters = result.config->cluster.tolerance > 0;
  const bool ground = !clusters && result.config->ground.method != GroundMethod::none;
  Picture picture;
  picture.up = result.config->ground.up;
  for (const Method* method : result.methods)
    picture.methods.emplace_back(method->name);
  picture.points = ground ? subset(frame.points, result.ground.rest) : result.kept_points(frame.points);
  if (clusters) picture.labels = labels.data();
  for (std::size_t id = 0; id < result.clusters.size(); ++id) {
    std::string label = clusters ? std::to_string(id) : "";  // at the first volume that is one
    for (std::uint32_t m = 0; m < result.methods.size(); ++m) {
      const AnyVolume& volume = result.volume(id, m);
      const std::uint32_t colour = clusters ? static_cast<std::uint32_t>(id) : m;
      picture.volumes.push_back({volume, colour, empty(volume) ? "" : std::exchange(label, {}), m});
    }
  }
  return picture;
}

}  // namespace pcl_bv
