// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scene.h"

#include "pcl_bv/io/number_text.h"

namespace pcl_bv::detail {
namespace {

msg::SceneColor scene_colour(const FrameResult& result, std::size_t cluster) {
  msg::SceneColor colour;
  topics::set_colour(colour_of(result, cluster), colour);
  return colour;
}

void add_volume(const VolumeShape& volume, const msg::SceneColor& colour, msg::SceneEntity& entity) {
  msg::Pose pose;
  topics::set_pose(volume, pose);
  msg::Vector3 size;
  topics::set_point(volume.size, size);
  switch (volume.kind) {
    case VolumeShape::Kind::cube:
      entity.cubes.push_back({pose, size, colour});
      break;
    case VolumeShape::Kind::sphere:
      entity.spheres.push_back({pose, size, colour});
      break;
    case VolumeShape::Kind::cylinder:
      entity.cylinders.push_back({pose, size, 1, 1, colour});
      break;
    case VolumeShape::Kind::lines:
      msg::LinePrimitive& lines = entity.lines.emplace_back();
      lines.thickness = 1.5;
      lines.scale_invariant = true;
      lines.color = {colour.r, colour.g, colour.b, 1};
      lines.points.resize(volume.line_points.size());
      for (std::size_t k = 0; k < volume.line_points.size(); ++k)
        topics::set_point(volume.line_points[k], lines.points[k]);
  }
}

void add_facts(const FrameResult& result, std::size_t cluster, msg::SceneEntity& entity) {
  const auto add = [&](const char* key, const std::string& value) {
    entity.metadata.push_back({key, value});
  };
  add("points", std::to_string(result.clusters.list_size(cluster)));
  if (!result.class_of.empty()) add("class", std::to_string(result.class_of[cluster]));
  const TrackEntry* const track = result.track_of(cluster);
  if (track == nullptr) return;
  add("age", std::to_string(track->age) + " frames");
  add("speed", fixed_text(track->velocity.norm(), 2) + " m/s");
  add("moving", track->moving ? "yes" : "no");
}

}  // namespace

void fill_scene(const Frame& frame, const FrameResult& result, const std::vector<VolumeShape>& volumes,
                std::int64_t lifetime_ns, ShownObjects& shown, msg::SceneUpdate& scene) {
  scene.entities.clear();
  scene.deletions.clear();
  std::set<std::pair<std::string, std::int32_t>> now;
  for (std::size_t i = 0; i < result.clusters.size(); ++i) {
    const VolumeShape box = box_of(result, i);
    if (box.kind != VolumeShape::Kind::cube) continue;  // a cluster without a volume
    msg::SceneEntity& entity = scene.entities.emplace_back();
    topics::set_time(frame.header.stamp_ns, entity.timestamp);
    entity.frame_id = frame.header.frame_id;
    entity.id = object_id(result, i);
    topics::set_time(lifetime_ns, entity.lifetime);
    now.emplace(entity.id, 0);
    const msg::SceneColor colour = scene_colour(result, i);
    for (std::size_t m = 0; m < result.methods.size(); ++m) {
      if (result.is_requested(i, m) && !empty(result.volume(i, m)))
        add_volume(volumes[i * result.methods.size() + m], colour, entity);
    }
    add_facts(result, i, entity);
    msg::TextPrimitive& text = entity.texts.emplace_back();
    topics::set_point(box.position, text.pose.position);
    text.pose.position.z += box.size[2] / 2 + 0.3;
    text.font_size = 14;
    text.scale_invariant = true;
    text.color = {colour.r, colour.g, colour.b, 1};
    text.text = entity.id;
  }
  for (const auto& [id, zero] : shown.replace(std::move(now))) {
    msg::SceneEntityDeletion& deletion = scene.deletions.emplace_back();
    topics::set_time(frame.header.stamp_ns, deletion.timestamp);
    deletion.id = id;
  }
}

}  // namespace pcl_bv::detail
