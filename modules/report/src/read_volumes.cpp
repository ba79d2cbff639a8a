// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/read_volumes.h"

#include <fstream>
#include <nlohmann/json.hpp>

namespace pcl_bv {
namespace {

using ReadJson = nlohmann::json;

Eigen::Vector3d read_vector(const ReadJson& numbers) {
  if (numbers.size() != 3) throw std::invalid_argument("three numbers are wanted, not " + numbers.dump());
  return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

std::vector<Eigen::Vector3d> read_vectors(const ReadJson& list) {
  std::vector<Eigen::Vector3d> found;
  for (const ReadJson& element : list)
    found.push_back(read_vector(element));
  return found;
}

Eigen::Matrix3d read_columns(const ReadJson& list) {
  if (list.size() != 3) throw std::invalid_argument("three axes are wanted");
  Eigen::Matrix3d m;
  m << read_vector(list[0]), read_vector(list[1]), read_vector(list[2]);
  return m;
}

SlabVector read_slabs(const ReadJson& list) {
  const auto numbers = list.get<std::vector<double>>();
  if (numbers.size() > KdopSet::max_size) throw std::invalid_argument("too many slabs");
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

Hull read_hull(const ReadJson& json) {
  std::vector<Hull::Triangle> faces;
  for (const ReadJson& face : json.at("faces"))
    faces.push_back(face.get<Hull::Triangle>());
  std::vector<HullPlane> planes;
  for (const ReadJson& plane : json.at("planes")) {
    const auto p = plane.get<std::array<double, 4>>();
    planes.push_back({{p[0], p[1], p[2]}, p[3]});
  }
  return {read_vectors(json.at("vertices")), std::move(faces), std::move(planes), json.value("rank", 3)};
}

AnyVolume read_volume(const ReadJson& json) {
  const auto shape = json.at("shape").get<std::string>();
  const auto point = [&](const char* key) { return read_vector(json.at(key)); };
  const auto number = [&](const char* key) { return json.at(key).get<double>(); };
  if (shape == "aabb") return Aabb(point("min"), point("max"));
  if (shape == "kdop") {
    auto set = std::make_shared<const KdopSet>(read_vectors(json.at("directions")));
    return Kdop(std::move(set), read_slabs(json.at("min")), read_slabs(json.at("max")));
  }
  if (shape == "sphere") return Sphere(point("center"), number("radius"));
  if (shape == "obb") return Obb(point("center"), read_columns(json.at("axes")), point("half_extents"));
  if (shape == "cylinder")
    return Cylinder(point("center"), point("axis"), number("radius"), number("half_height"));
  if (shape == "capsule") return Capsule(point("a"), point("b"), number("radius"));
  if (shape == "ellipsoid") return Ellipsoid(point("center"), read_columns(json.at("axes")), point("radii"));
  if (shape == "hull") return read_hull(json);
  throw std::invalid_argument("'" + shape + "' is no shape");
}

void collect(const ReadJson& json, std::vector<AnyVolume>& volumes) {
  if (json.is_object() && json.contains("shape")) {
    if (!json.contains("empty") && !json.contains("failed")) volumes.push_back(read_volume(json));
  } else if (json.is_structured()) {
    for (const ReadJson& element : json)
      collect(element, volumes);
  }
}

}  // namespace

std::vector<AnyVolume> read_volumes(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& what) { throw IoError(file.string() + ": " + what); };
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file)) fail("cannot be read");
  std::vector<AnyVolume> volumes;
  try {
    while (in >> std::ws && !in.eof()) {
      ReadJson json;
      in >> json;  // one value; the next line may have another
      collect(json, volumes);
    }
  } catch (const std::exception& error) {
    fail(error.what());
  }
  if (volumes.empty()) fail("no volumes in it");
  return volumes;
}

}  // namespace pcl_bv
