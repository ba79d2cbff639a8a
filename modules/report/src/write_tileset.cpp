// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <tuple>

#include "formatting.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/report/tileset.h"
#include "text_sink.h"
#include "tile_volumes.h"

namespace pcl_bv::detail {
namespace {

// The first volume of a cluster that becomes a bounding volume of 3D Tiles, or null.
const AnyVolume* tile_volume_of(const ClusterEntry& cluster, TileFrame frame) {
  for (const VolumeEntry& entry : cluster.volumes) {
    const bool known = std::holds_alternative<Aabb>(entry.volume) ||
                       (frame == TileFrame::cartesian && (std::holds_alternative<Sphere>(entry.volume) ||
                                                          std::holds_alternative<Obb>(entry.volume)));
    if (known && !empty(entry.volume)) return &entry.volume;
  }
  return nullptr;
}

void add_volume(const AnyVolume& volume, TileFrame frame, JsonText& json) {
  json.key("boundingVolume");
  if (const auto* sphere = std::get_if<Sphere>(&volume)) {
    json.begin('{').add("sphere", tile_numbers(*sphere)).end('}');
  } else if (const auto* box = std::get_if<Obb>(&volume)) {
    json.begin('{').add("box", tile_numbers(*box)).end('}');
  } else if (frame == TileFrame::cartesian) {
    json.begin('{').add("box", tile_numbers(Obb(std::get<Aabb>(volume)))).end('}');
  } else {
    add_tile_region(std::get<Aabb>(volume), json);
  }
}

void require_geographic(const Aabb& all) {
  const Eigen::Vector3d largest = all.min().cwiseAbs().cwiseMax(all.max().cwiseAbs());
  for (const auto& [name, axis, limit] :
       {std::tuple("longitude", 0, 180.0), std::tuple("latitude", 1, 90.0)}) {
    if (largest[axis] <= limit) continue;
    const double worst = -all.min()[axis] > limit ? all.min()[axis] : all.max()[axis];
    throw IoError("has the " + std::string(name) + ' ' + shortest(worst) + "; allowed are -" +
                  shortest(limit) + " to " + shortest(limit) +
                  " degrees. x, y, z must be longitude, latitude, height");
  }
}

// Returns the length of the diagonal, the error if no tile is shown. For geographic coordinates it is an
// upper bound in metres: 6399594 m is the largest radius of curvature of WGS84, at the poles.
double size_of(const Aabb& all, TileFrame frame) {
  Eigen::Vector3d size = all.max() - all.min();
  if (frame == TileFrame::geographic)
    size.head<2>() *= (6399594 + std::max(0.0, all.max().z())) * (M_PI / 180);
  return size.norm();
}

}  // namespace

void write_tileset(const Report& report, const ClusterSource& clusters, TileFrame frame,
                   const TextSink& take) {
  if (report.error) return;
  Aabb all;
  std::size_t tiles = 0;
  for (std::size_t i = 0; i < clusters.count; ++i) {
    const AnyVolume* const volume = tile_volume_of(clusters.at(i), frame);
    if (volume == nullptr) continue;
    all.merge(aabb(*volume));
    ++tiles;
  }
  if (tiles == 0) all = Aabb(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
  if (frame == TileFrame::geographic) require_geographic(all);
  std::string text;
  JsonText json(text);
  const double size = size_of(all, frame);
  json.begin('{').key("asset").begin('{').add("version", "1.1").add("generator", "pcl_bv").end('}');
  json.add("geometricError", size).key("root").begin('{');
  add_volume(all, frame, json);
  json.add("geometricError", size).add("refine", "ADD");
  if (tiles > 0) json.key("children").begin('[');
  for (std::size_t i = 0; i < clusters.count; ++i) {
    const ClusterEntry& cluster = clusters.at(i);
    if (const AnyVolume* const volume = tile_volume_of(cluster, frame)) {
      text += '\n';
      json.begin('{');
      add_volume(*volume, frame, json);
      json.add("geometricError", 0).key("extras").begin('{').add("id", cluster.id);
      json.add("points", cluster.points).end('}').end('}');
    }
    take_if_long(text, take);
  }
  if (tiles > 0) json.end(']');
  json.end('}').end('}');
  text += '\n';
  take(text);
}

}  // namespace pcl_bv::detail
