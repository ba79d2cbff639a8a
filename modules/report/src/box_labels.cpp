// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/box_labels.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include "formatting.h"
#include "json_text.h"
#include "text_sink.h"

namespace pcl_bv::detail {
namespace {

std::optional<Obb> label_box_of(const ClusterEntry& cluster, bool only_upright) {
  const Obb* oriented = nullptr;
  const Aabb* aligned = nullptr;
  for (const VolumeEntry& entry : cluster.volumes) {
    if (empty(entry.volume)) continue;
    if (const Obb* const upright = upright_box(entry)) return *upright;
    if (oriented == nullptr) oriented = std::get_if<Obb>(&entry.volume);
    if (aligned == nullptr) aligned = std::get_if<Aabb>(&entry.volume);
  }
  if (oriented != nullptr && !only_upright) return *oriented;
  if (aligned == nullptr) return std::nullopt;
  // Not Obb(Aabb), which may be larger by a rounding error and would change numbers that were measured.
  const Eigen::Vector3d half = (aligned->max() - aligned->min()) / 2;
  return Obb(aligned->min() + half, Eigen::Matrix3d::Identity(), half);
}

std::string label_type_of(const ClusterEntry& cluster, const BoxLabelOptions& options, const char* unknown) {
  if (!options.type.empty()) return options.type;
  return cluster.class_value ? std::to_string(*cluster.class_value) : unknown;
}

// Columns of KITTI: type, truncated, occluded, alpha, 2D box, height, width, length, location, rotation_y.
// The camera at the origin looks along x, so its axes x, y, z are -y, -z, x of the cloud.
void append_kitti(const Obb& box, const std::string& type, std::string& text) {
  const Eigen::Vector3d &center = box.center(), &half = box.half_extents();
  const Eigen::Vector3d bottom(-center.y(), -(center.z() - half.z()), center.x());
  const double rotation = std::atan2(-box.axes()(0, 0), -box.axes()(1, 0));
  double alpha = rotation - std::atan2(bottom.x(), bottom.z());
  if (std::abs(alpha) > M_PI) alpha -= std::copysign(2 * M_PI, alpha);
  text += type + " -1 -1 ";
  append_shortest(alpha, text);
  text += " -1 -1 -1 -1";
  for (const double value :
       {2 * half.z(), 2 * half.y(), 2 * half.x(), bottom.x(), bottom.y(), bottom.z(), rotation})
    append_shortest(value, text += ' ');
  text += '\n';
}

void add_nuscenes(const Obb& box, const ClusterEntry& cluster, const std::string& file,
                  const std::string& type, JsonText& json) {
  const Eigen::Vector3d size = 2 * box.half_extents();
  const Eigen::Quaterniond q = box.quaternion();
  const Eigen::Vector3d velocity = cluster.track ? cluster.track->velocity : Eigen::Vector3d(0, 0, 0);
  json.begin('{').add("sample_token", file).add("translation", box.center());
  json.add("size", Eigen::Vector3d(size.y(), size.x(), size.z()));  // width, length, height
  json.add("rotation", std::array{q.w(), q.x(), q.y(), q.z()});
  json.add("velocity", std::array{velocity.x(), velocity.y()});
  json.add("detection_name", type).add("detection_score", -1).add("attribute_name", "").end('}');
}

// The key of an object must be a number or a UUID, which must differ from those of all other frames. It has
// the version 8, whose bits are free.
std::string openlabel_key(std::size_t id, const std::optional<std::size_t>& frame) {
  if (!frame) return std::to_string(id);
  char text[64];
  std::snprintf(text, sizeof text, "%08zx-0000-8000-8000-%012zx", *frame & 0xFFFFFFFF, id & 0xFFFFFFFFFFFF);
  return text;
}

void add_openlabel(const Obb& box, const ClusterEntry& cluster, const std::string& file,
                   const std::string& type, const std::optional<std::size_t>& frame, JsonText& json) {
  const Eigen::Vector3d &center = box.center(), size = 2 * box.half_extents();
  const Eigen::Quaterniond q = box.quaternion();
  json.key(openlabel_key(cluster.id, frame)).begin('{');
  json.add("name", "object " + std::to_string(cluster.id)).add("type", type);
  if (frame) {
    json.key("frame_intervals").begin('[').begin('{').add("frame_start", *frame).add("frame_end", *frame);
    json.end('}').end(']');
  }
  json.key("object_data").begin('{').key("cuboid").begin('[').begin('{');
  json.add("name", "box").add("coordinate_system", "cloud");
  json.add("val", std::array{center.x(), center.y(), center.z(), q.x(), q.y(), q.z(), q.w(), size.x(),
                             size.y(), size.z()});
  json.end('}').end(']').key("num").begin('[').begin('{').add("name", "points").add("val", cluster.points);
  json.end('}').end(']').key("text").begin('[').begin('{').add("name", "file").add("val", file);
  json.end('}').end(']').end('}').end('}');
}

// Angles a, b, c with axes = Rx(a) Ry(b) Rz(c), the convention of SUSTechPOINTS.
Eigen::Vector3d sustech_angles(const Eigen::Matrix3d& axes) {
  const double cosine = std::hypot(axes(0, 0), axes(0, 1));
  if (cosine < 1e-9) return {0, std::atan2(axes(0, 2), cosine), std::atan2(axes(1, 0), axes(1, 1))};
  return {std::atan2(-axes(1, 2), axes(2, 2)), std::atan2(axes(0, 2), cosine),
          std::atan2(-axes(0, 1), axes(0, 0))};
}

void add_sustech(const Obb& box, const ClusterEntry& cluster, const std::string& type, JsonText& json) {
  const auto add = [&](const char* key, const Eigen::Vector3d& v) {
    json.key(key).begin('{').add("x", v.x()).add("y", v.y()).add("z", v.z()).end('}');
  };
  json.begin('{').add("obj_id", std::to_string(cluster.track ? cluster.track->id : cluster.id));
  json.add("obj_type", type).key("psr").begin('{');
  add("position", box.center());
  add("scale", 2 * box.half_extents());
  add("rotation", sustech_angles(box.axes()));
  json.end('}').end('}');
}

}  // namespace

BoxLabelFile box_label_file(BoxLabelFormat format) {
  switch (format) {
    case BoxLabelFormat::nuscenes:
      return {R"({"meta":{"use_camera":false,"use_lidar":true,"use_radar":false,"use_map":false,)"
              R"("use_external":false},"results":{)"
              "\n",
              ",\n", "\n}}\n"};
    case BoxLabelFormat::openlabel:
      return {R"({"openlabel":{"metadata":{"schema_version":"1.0.0","annotator":"pcl_bv"},)"
              R"("coordinate_systems":{"cloud":{"type":"sensor_cs","parent":"","children":[]}},"objects":{)"
              "\n",
              ",\n", "\n}}}\n"};
    case BoxLabelFormat::sustech:
      return {"[\n", ",\n", "\n]\n"};
    case BoxLabelFormat::kitti:
    case BoxLabelFormat::kitti_tracking:
      break;
  }
  return {};
}

void write_box_labels(const Report& report, const ClusterSource& clusters, BoxLabelFormat format,
                      const BoxLabelOptions& options, const TextSink& take) {
  if (report.error) return;
  const bool tracking = format == BoxLabelFormat::kitti_tracking;
  const bool kitti = tracking || format == BoxLabelFormat::kitti;
  std::string text;
  JsonText json(text);
  // An input without objects has an entry in nuScenes' format, because its devkit wants one for each sample.
  if (format == BoxLabelFormat::nuscenes) json.key(report.file).begin('[');
  for (std::size_t i = 0; i < clusters.count; ++i) {
    const ClusterEntry& cluster = clusters.at(i);
    const std::optional<Obb> box = label_box_of(cluster, kitti);
    if (!box) continue;
    if (kitti) {
      const std::string track = cluster.track ? std::to_string(cluster.track->id) : "-1";
      if (tracking) text += std::to_string(options.frame.value_or(0)) + ' ' + track + ' ';
      append_kitti(*box, label_type_of(cluster, options, "Misc"), text);
    } else if (format == BoxLabelFormat::nuscenes) {
      add_nuscenes(*box, cluster, report.file, label_type_of(cluster, options, "unknown"), json);
    } else if (format == BoxLabelFormat::openlabel) {
      add_openlabel(*box, cluster, report.file, label_type_of(cluster, options, "unknown"), options.frame,
                    json);
    } else {
      add_sustech(*box, cluster, label_type_of(cluster, options, "Unknown"), json);
    }
    take_if_long(text, take);
  }
  if (format == BoxLabelFormat::nuscenes) json.end(']');
  take(text);
}

}  // namespace pcl_bv::detail
