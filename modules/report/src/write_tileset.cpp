// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/tileset.h"
#include "text_sink.h"
#include "tile_volumes.h"

namespace pcl_bv::detail {
namespace {

// The first box or sphere of a cluster, or null.
const AnyVolume* tile_volume_of(const ClusterEntry& cluster) {
  for (const VolumeEntry& entry : cluster.volumes) {
    const bool known = std::holds_alternative<Sphere>(entry.volume) ||
                       std::holds_alternative<Obb>(entry.volume) ||
                       std::holds_alternative<Aabb>(entry.volume);
    if (known && !empty(entry.volume)) return &entry.volume;
  }
  return nullptr;
}

void add_tile(const ClusterEntry& cluster, const AnyVolume& volume, JsonText& json) {
  json.begin('{').key("boundingVolume");
  if (const auto* sphere = std::get_if<Sphere>(&volume)) {
    add_tile_volume(*sphere, json);
  } else if (const auto* box = std::get_if<Obb>(&volume)) {
    add_tile_volume(*box, json);
  } else {
    add_tile_volume(Obb(std::get<Aabb>(volume)), json);
  }
  json.add("geometricError", 0).key("extras").begin('{').add("id", cluster.id).add("points", cluster.points);
  json.end('}').end('}');
}

}  // namespace

void write_tileset(const Report& report, const ClusterSource& clusters, const TextSink& take) {
  if (report.error) return;
  Aabb all;
  std::size_t tiles = 0;
  for (std::size_t i = 0; i < clusters.count; ++i) {
    const AnyVolume* const volume = tile_volume_of(clusters.at(i));
    if (volume == nullptr) continue;
    all.merge(aabb(*volume));
    ++tiles;
  }
  if (tiles == 0) all = Aabb(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
  std::string text;
  JsonText json(text);
  const double size = (all.max() - all.min()).norm();  // the error if no tile is shown
  json.begin('{').key("asset").begin('{').add("version", "1.1").add("generator", "pcl_bv").end('}');
  json.add("geometricError", size).key("root").begin('{').key("boundingVolume");
  add_tile_volume(Obb(all), json);
  json.add("geometricError", size).add("refine", "ADD");
  if (tiles > 0) json.key("children").begin('[');
  for (std::size_t i = 0; i < clusters.count; ++i) {
    const ClusterEntry& cluster = clusters.at(i);
    if (const AnyVolume* const volume = tile_volume_of(cluster)) {
      text += '\n';
      add_tile(cluster, *volume, json);
    }
    take_if_long(text, take);
  }
  if (tiles > 0) json.end(']');
  json.end('}').end('}');
  text += '\n';
  take(text);
}

}  // namespace pcl_bv::detail
