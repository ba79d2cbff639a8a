// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes reports as JSON. std::to_chars writes the numbers, because it guarantees the fewest digits that read
// back exactly.

#include <cmath>

#include "json_text.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/report/cluster_json.h"
#include "pcl_bv/report/report.h"
#include "text_sink.h"

namespace pcl_bv {
using namespace detail;
namespace {

void add_axes(const Eigen::Matrix3d& axes, JsonText& json) {
  json.key("axes").begin('[');
  for (int axis = 0; axis < 3; ++axis)
    json.value(axes.col(axis));
  json.end(']');
}

void add_numbers(const Aabb& box, JsonText& json) {
  json.add("min", box.min()).add("max", box.max());
}

void add_numbers(const Kdop& kdop, JsonText& json) {
  json.key("directions").begin('[');
  for (std::size_t i = 0; i < kdop.size(); ++i)
    json.value(kdop.set()->direction(i));
  json.end(']').add("min", kdop.min()).add("max", kdop.max());
}

void add_numbers(const Sphere& sphere, JsonText& json) {
  json.add("center", sphere.center()).add("radius", sphere.radius());
}

void add_numbers(const Obb& box, JsonText& json) {
  json.add("center", box.center());
  add_axes(box.axes(), json);
  json.add("half_extents", box.half_extents());
  json.add("quaternion", box.quaternion().coeffs());  // x, y, z, w
}

void add_numbers(const Cylinder& cylinder, JsonText& json) {
  json.add("center", cylinder.center()).add("axis", cylinder.axis());
  json.add("radius", cylinder.radius()).add("half_height", cylinder.half_height());
}

void add_numbers(const Capsule& capsule, JsonText& json) {
  json.add("a", capsule.a()).add("b", capsule.b()).add("radius", capsule.radius());
}

void add_numbers(const Ellipsoid& ellipsoid, JsonText& json) {
  json.add("center", ellipsoid.center());
  add_axes(ellipsoid.axes(), json);
  json.add("radii", ellipsoid.radii());
}

void add_numbers(const Hull& hull, JsonText& json) {
  json.add("vertices", hull.vertices()).add("faces", hull.triangles()).key("planes").begin('[');
  for (const HullPlane& p : hull.planes())
    json.value(std::array{p.normal.x(), p.normal.y(), p.normal.z(), p.offset});
  json.end(']');
  if (hull.rank() < 3) json.add("rank", hull.rank());
}

void add_numbers(const Prism& prism, JsonText& json) {
  add_axes(prism.axes(), json);
  json.add("outline", prism.outline()).add("low", prism.low()).add("high", prism.high());
}

void add_volume(const VolumeEntry& entry, JsonText& json) {
  json.begin('{').add("shape", shape_name(entry.volume)).add("method", entry.method);
  if (!entry.failed.empty()) {
    json.add("failed", entry.failed);
  } else if (empty(entry.volume)) {
    json.add("empty", true);
  } else {
    json.add("volume", volume(entry.volume));
    std::visit([&](const auto& shape) { add_numbers(shape, json); }, entry.volume);
  }
  if (entry.outside) json.add("outside", *entry.outside);
  json.end('}');
}

void add_field(const PointField& field, JsonText& json) {
  json.begin('{').add("name", field.name).add("type", std::string(1, field.type));
  json.add("size", field.size).add("count", field.count).end('}');
}

/// Adds the statistics of the cloud, without the box of an empty cloud and without an unknown spacing.
void add_info(const CloudInfo& info, JsonText& json) {
  json.key("info").begin('{');
  if (!info.box.empty()) add_numbers(info.box, json);
  if (info.spacing) json.add("spacing", *info.spacing);
  json.add("organized", info.height > 1).add("nonfinite", info.nonfinite).add("zero", info.zero);
  json.key("fields").begin('[');
  for (const PointField& field : info.fields)
    add_field(field, json);
  json.end(']').end('}');
}

/// Rounds to microseconds. Further digits of the clock are not useful.
double rounded_to_microseconds(double seconds) {
  return std::round(seconds * 1e6) / 1e6;
}

void add_volumes(const ClusterEntry& cluster, JsonText& json) {
  json.add("points", cluster.points).key("volumes").begin('[');
  for (const VolumeEntry& entry : cluster.volumes)
    add_volume(entry, json);
  json.end(']').end('}');
}

void add_refinement(JsonText& json, Refinement refinement) {
  if (refinement == Refinement::cut) json.add("cut", true);
  if (refinement == Refinement::joined) json.add("joined", true);
}

void add_sensors(const std::vector<SensorEntry>& sensors, JsonText& json) {
  if (sensors.empty()) return;
  json.key("sensors").begin('[');
  for (const SensorEntry& sensor : sensors) {
    json.begin('{').add("name", sensor.name).add("points", sensor.points);
    if (sensor.points > 0) json.add("stamp_ns", sensor.stamp_ns);
    json.end('}');
  }
  json.end(']');
}

void add_counts(const Counts& counts, JsonText& json) {
  json.key("counts").begin('{').add("nonfinite", counts.nonfinite).add("range", counts.range);
  json.add("ground", counts.ground).add("small", counts.small).add("large", counts.large);
  json.add("noise", counts.noise).add("inside", counts.inside).add("class", counts.dropped_class);
  if (counts.cut > 0) json.add("cut", counts.cut);
  if (counts.joined > 0) json.add("joined", counts.joined);
  json.end('}');
}

void add_track(const TrackEntry& track, JsonText& json) {
  json.add("age", track.age).add("velocity", track.velocity).add("moving", track.moving);
  json.add("pose", track.pose).add("covariance", track.covariance);
}

}  // namespace

void write_report_json(const Report& report, const ClusterSource& clusters, const TextSink& take) {
  std::string text;
  JsonText json(text);
  json.begin('{').add("schema", 1).add("file", report.file);
  if (report.error) {
    json.add("error", message_line(*report.error)).end('}');
    return take(text);
  }
  if (report.parts) json.add("parts", *report.parts);
  if (!report.left_out.empty()) {
    json.key("left_out").begin('[');
    for (const LeftOutInput& input : report.left_out)
      json.begin('{').add("file", input.file).add("error", message_line(input.error)).end('}');
    json.end(']');
  }
  json.add("points", report.points);
  if (report.origin) json.add("origin", *report.origin);
  add_counts(report.counts, json);
  if (report.info) add_info(*report.info, json);
  json.key("clusters").begin('[');
  for (std::size_t i = 0; i < clusters.count; ++i) {
    const ClusterEntry& cluster = clusters.at(i);
    json.begin('{').add("id", cluster.id);
    if (cluster.class_value) json.add("class", *cluster.class_value);
    if (cluster.incomplete) json.add("incomplete", true);
    add_refinement(json, cluster.refinement);
    add_volumes(cluster, json);
    take_if_long(text, take);
  }
  json.end(']');
  if (report.seconds) {
    json.key("seconds").begin('{').add("read", rounded_to_microseconds(report.seconds->read));
    json.add("segment", rounded_to_microseconds(report.seconds->segment));
    json.add("fit", rounded_to_microseconds(report.seconds->fit)).end('}');
  }
  json.end('}');
  take(text);
}

std::string detail::cluster_json(const ClusterEntry& cluster) {
  std::string text;
  JsonText json(text);
  json.begin('{').add("id", cluster.id);
  if (cluster.class_value) json.add("class", *cluster.class_value);
  add_volumes(cluster, json);
  return text;
}

std::string report_json(const Report& report) {
  std::string all;
  write_report_json(report, vector_source(report.clusters), appended_to(all));
  return all;
}

std::string frame_json(const FrameReport& report) {
  return frame_json(report, vector_source(report.clusters));
}

std::string frame_json(const FrameReport& report, const ClusterSource& clusters) {
  std::string text;
  JsonText json(text);
  json.begin('{').add("schema", 1).add("seq", report.seq).add("stamp_ns", report.stamp_ns);
  json.add("frame_id", report.frame_id);
  if (!report.file.empty()) json.add("file", report.file);
  if (report.error) {
    json.add("error", message_line(*report.error)).end('}');
    return text;
  }
  json.add("points", report.points);
  add_counts(report.counts, json);
  if (!report.deskew.empty()) json.add("deskew", report.deskew);
  add_sensors(report.sensors, json);
  json.key("clusters").begin('[');
  for (std::size_t i = 0; i < clusters.count; ++i) {
    const ClusterEntry& cluster = clusters.at(i);
    json.begin('{').add("id", cluster.id).key("track");
    if (cluster.track) {
      json.value(cluster.track->id);
    } else {
      json.value(nullptr);
    }
    if (cluster.class_value) json.add("class", *cluster.class_value);
    add_refinement(json, cluster.refinement);
    if (cluster.track) add_track(*cluster.track, json);
    add_volumes(cluster, json);
  }
  json.end(']').key("ms").begin('{');
  for (const auto& [stage, milliseconds] : report.ms)
    json.add(stage, std::round(milliseconds * 1e3) / 1e3);
  json.end('}').end('}');
  return text;
}

}  // namespace pcl_bv
