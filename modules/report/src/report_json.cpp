// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reports as JSON. The tree and the escaping are nlohmann's; the numbers are not, because its Grisu2 does not
// always give the shortest digits, and only std::to_chars promises digits that read back exactly.

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "pcl_bv/report/frame_report.h"
#include "pcl_bv/report/report.h"
#include "written.h"

namespace pcl_bv {
namespace {

using Json = nlohmann::ordered_json;

void write(const Json& value, std::string& out);

void write_object(const Json& object, std::string& out) {
  char before = '{';
  for (const auto& [key, value] : object.items()) {
    out += before;
    write(key, out);
    out += ':';
    write(value, out);
    before = ',';
  }
  out += object.empty() ? "{}" : "}";
}

void write_array(const Json& array, std::string& out) {
  char before = '[';
  for (const Json& value : array) {
    out += before;
    write(value, out);
    before = ',';
  }
  out += array.empty() ? "[]" : "]";
}

void write(const Json& value, std::string& out) {
  if (value.is_object()) {
    write_object(value, out);
  } else if (value.is_array()) {
    write_array(value, out);
  } else if (value.is_number_float()) {
    out += shortest(value.get<double>());
  } else {
    out += value.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
}

// On one line; the fewest digits that read back exactly, never -0.
std::string to_text(const Json& json) {
  std::string text;
  write(json, text);
  return text;
}

// Eigen's vectors are ranges, which become arrays.
Json columns(const Eigen::Matrix3d& axes) {
  return {Eigen::Vector3d(axes.col(0)), Eigen::Vector3d(axes.col(1)), Eigen::Vector3d(axes.col(2))};
}

void add_numbers(const Aabb& box, Json& entry) {
  entry["min"] = box.min();
  entry["max"] = box.max();
}

void add_numbers(const Kdop& kdop, Json& entry) {
  entry["directions"] = Json::array();
  for (std::size_t i = 0; i < kdop.size(); ++i)
    entry["directions"].push_back(kdop.set()->direction(i));
  entry["min"] = kdop.min();
  entry["max"] = kdop.max();
}

void add_numbers(const Sphere& sphere, Json& entry) {
  entry["center"] = sphere.center();
  entry["radius"] = sphere.radius();
}

void add_numbers(const Obb& box, Json& entry) {
  entry["center"] = box.center();
  entry["axes"] = columns(box.axes());
  entry["half_extents"] = box.half_extents();
  entry["quaternion"] = box.quaternion().coeffs();  // x, y, z, w
}

void add_numbers(const Cylinder& cylinder, Json& entry) {
  entry["center"] = cylinder.center();
  entry["axis"] = cylinder.axis();
  entry["radius"] = cylinder.radius();
  entry["half_height"] = cylinder.half_height();
}

void add_numbers(const Capsule& capsule, Json& entry) {
  entry["a"] = capsule.a();
  entry["b"] = capsule.b();
  entry["radius"] = capsule.radius();
}

void add_numbers(const Ellipsoid& ellipsoid, Json& entry) {
  entry["center"] = ellipsoid.center();
  entry["axes"] = columns(ellipsoid.axes());
  entry["radii"] = ellipsoid.radii();
}

void add_numbers(const Hull& hull, Json& entry) {
  entry["vertices"] = hull.vertices();
  entry["faces"] = hull.triangles();
  entry["planes"] = Json::array();
  for (const HullPlane& p : hull.planes())
    entry["planes"].push_back({p.normal.x(), p.normal.y(), p.normal.z(), p.offset});
  if (hull.rank() < 3) entry["rank"] = hull.rank();
}

Json volume_json(const VolumeEntry& entry) {
  Json json{{"shape", std::string(shape_name(entry.volume))}, {"method", entry.method}};
  if (!entry.failed.empty()) {
    json["failed"] = entry.failed;
  } else if (empty(entry.volume)) {
    json["empty"] = true;
  } else {
    json["volume"] = volume(entry.volume);
    std::visit([&](const auto& shape) { add_numbers(shape, json); }, entry.volume);
  }
  if (entry.outside) json["outside"] = *entry.outside;
  return json;
}

/// What there is none of is left out.
Json info_json(const CloudInfo& info) {
  Json json;
  if (!info.box.empty()) add_numbers(info.box, json);
  if (info.spacing) json["spacing"] = *info.spacing;
  json["organized"] = info.height > 1;
  json["nonfinite"] = info.nonfinite;
  json["zero"] = info.zero;
  json["fields"] = Json::array();
  for (const PointField& field : info.fields) {
    json["fields"].push_back({{"name", field.name},
                              {"type", std::string(1, field.type)},
                              {"size", field.size},
                              {"count", field.count}});
  }
  return json;
}

/// Microseconds are all that a clock reading is worth.
double microseconds_exact(double seconds) {
  return std::round(seconds * 1e6) / 1e6;
}

Json volumes_json(const ClusterEntry& cluster) {
  Json volumes = Json::array();
  for (const VolumeEntry& entry : cluster.volumes)
    volumes.push_back(volume_json(entry));
  return volumes;
}

Json counts_json(const Counts& counts) {
  return {{"nonfinite", counts.nonfinite}, {"range", counts.range},   {"ground", counts.ground},
          {"small", counts.small},         {"large", counts.large},   {"noise", counts.noise},
          {"inside", counts.inside},       {"class", counts.of_class}};
}

}  // namespace

std::string report_json(const Report& report) {
  Json json{{"schema", 1}, {"file", report.file}};
  if (report.error) {
    json["error"] = *report.error;
  } else {
    if (report.parts) json["parts"] = *report.parts;
    json["points"] = report.points;
    if (report.origin) json["origin"] = {(*report.origin)[0], (*report.origin)[1], (*report.origin)[2]};
    json["counts"] = counts_json(report.counts);
    if (report.info) json["info"] = info_json(*report.info);
    json["clusters"] = Json::array();
    for (const ClusterEntry& cluster : report.clusters) {
      Json entry{{"id", cluster.id}};
      if (cluster.class_value) entry["class"] = *cluster.class_value;
      entry["points"] = cluster.points;
      entry["volumes"] = volumes_json(cluster);
      json["clusters"].push_back(std::move(entry));
    }
    if (report.seconds) {
      json["seconds"] = {{"read", microseconds_exact(report.seconds->read)},
                         {"segment", microseconds_exact(report.seconds->segment)},
                         {"fit", microseconds_exact(report.seconds->fit)}};
    }
  }
  return to_text(json);
}

std::string frame_json(const FrameReport& report) {
  Json json{{"schema", 1}, {"seq", report.seq}, {"stamp_ns", report.stamp_ns}, {"frame_id", report.frame_id}};
  if (!report.file.empty()) json["file"] = report.file;
  if (report.error) {
    json["error"] = *report.error;
    return to_text(json);
  }
  json["points"] = report.points;
  json["counts"] = counts_json(report.counts);
  json["clusters"] = Json::array();
  for (const ClusterEntry& cluster : report.clusters) {
    Json entry{{"id", cluster.id}, {"track", nullptr}};
    if (cluster.class_value) entry["class"] = *cluster.class_value;
    if (const TrackEntry* track = cluster.track ? &*cluster.track : nullptr; track != nullptr) {
      entry["track"] = track->id;
      entry["age"] = track->age;
      entry["velocity"] = {track->velocity.x(), track->velocity.y(), track->velocity.z()};
      entry["moving"] = track->moving;
      entry["pose"] = track->pose;
      entry["covariance"] = track->covariance;
    }
    entry["points"] = cluster.points;
    entry["volumes"] = volumes_json(cluster);
    json["clusters"].push_back(std::move(entry));
  }
  json["ms"] = Json::object();
  for (const auto& [stage, milliseconds] : report.ms)
    json["ms"][stage] = std::round(milliseconds * 1e3) / 1e3;
  return to_text(json);
}

}  // namespace pcl_bv
