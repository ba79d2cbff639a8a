// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reports as JSON. The tree and the escaping are nlohmann's; the numbers are not, because its Grisu2 does not
// always give the shortest digits, and only std::to_chars promises digits that read back exactly.

#include <cmath>

#include "pcl_bv/report/report.h"
#include "report_tree.h"
#include "shortest.h"

namespace pcl_bv {
namespace {

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

Json array3(const Eigen::Vector3d& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

void add_numbers(const Aabb& box, Json& entry) {
  entry["min"] = array3(box.min());
  entry["max"] = array3(box.max());
}

void add_numbers(const Kdop& kdop, Json& entry) {
  Json directions = Json::array(), min = Json::array(), max = Json::array();
  for (std::size_t i = 0; i < kdop.size(); ++i) {
    directions.push_back(array3(kdop.set()->direction(i)));
    min.push_back(kdop.min(i));
    max.push_back(kdop.max(i));
  }
  entry["directions"] = std::move(directions);
  entry["min"] = std::move(min);
  entry["max"] = std::move(max);
}

void add_numbers(const Sphere& sphere, Json& entry) {
  entry["center"] = array3(sphere.center());
  entry["radius"] = sphere.radius();
}

void add_numbers(const Obb& box, Json& entry) {
  entry["center"] = array3(box.center());
  entry["axes"] = Json::array({array3(box.axis(0)), array3(box.axis(1)), array3(box.axis(2))});
  entry["half_extents"] = array3(box.half_extents());
  const Eigen::Quaterniond q = box.quaternion();
  entry["quaternion"] = Json::array({q.x(), q.y(), q.z(), q.w()});
}

void add_numbers(const Cylinder& cylinder, Json& entry) {
  entry["center"] = array3(cylinder.center());
  entry["axis"] = array3(cylinder.axis());
  entry["radius"] = cylinder.radius();
  entry["half_height"] = cylinder.half_height();
}

void add_numbers(const Capsule& capsule, Json& entry) {
  entry["a"] = array3(capsule.a());
  entry["b"] = array3(capsule.b());
  entry["radius"] = capsule.radius();
}

void add_numbers(const Ellipsoid& ellipsoid, Json& entry) {
  entry["center"] = array3(ellipsoid.center());
  const Eigen::Matrix3d& axes = ellipsoid.axes();
  entry["axes"] = Json::array({array3(axes.col(0)), array3(axes.col(1)), array3(axes.col(2))});
  entry["radii"] = array3(ellipsoid.radii());
}

void add_numbers(const Hull& hull, Json& entry) {
  Json vertices = Json::array(), faces = Json::array(), planes = Json::array();
  for (const Eigen::Vector3d& v : hull.vertices())
    vertices.push_back(array3(v));
  for (const Hull::Triangle& t : hull.triangles())
    faces.push_back(Json::array({t[0], t[1], t[2]}));
  for (const HullPlane& p : hull.planes())
    planes.push_back(Json::array({p.normal.x(), p.normal.y(), p.normal.z(), p.offset}));
  entry["vertices"] = std::move(vertices);
  entry["faces"] = std::move(faces);
  entry["planes"] = std::move(planes);
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

}  // namespace

Json volumes_json(const ClusterEntry& cluster) {
  Json volumes = Json::array();
  for (const VolumeEntry& entry : cluster.volumes)
    volumes.push_back(volume_json(entry));
  return volumes;
}

Json counts_json(const Counts& counts) {
  return {{"nonfinite", counts.nonfinite},
          {"range", counts.range},
          {"ground", counts.ground},
          {"small", counts.small},
          {"large", counts.large}};
}

std::string to_text(const Json& json) {
  std::string text;
  write(json, text);
  return text;
}

std::string report_json(const Report& report) {
  Json json{{"schema", 1}, {"file", report.file}};
  if (report.error) {
    json["error"] = *report.error;
  } else {
    json["points"] = report.points;
    json["counts"] = counts_json(report.counts);
    if (report.info) json["info"] = info_json(*report.info);
    json["clusters"] = Json::array();
    for (const ClusterEntry& cluster : report.clusters) {
      json["clusters"].push_back(
          {{"id", cluster.id}, {"points", cluster.points}, {"volumes", volumes_json(cluster)}});
    }
    if (report.seconds) {
      json["seconds"] = {{"read", microseconds_exact(report.seconds->read)},
                         {"segment", microseconds_exact(report.seconds->segment)},
                         {"fit", microseconds_exact(report.seconds->fit)}};
    }
  }
  return to_text(json);
}

}  // namespace pcl_bv
