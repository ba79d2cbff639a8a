// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/read_volumes.h"

#include <algorithm>
#include <cstdint>

#include "json_numbers.h"
#include "pcl_bv/report/cluster_json.h"
#include "read_box_labels.h"

namespace pcl_bv::detail {
namespace {

using Json = UntrustedJson;

std::vector<Eigen::Vector3d> vectors_of(const char* key, const Json& value) {
  std::vector<Eigen::Vector3d> found;
  for (const Json& element : list_of(key, value))
    found.push_back(vector_of(key, element));
  return found;
}

Eigen::Matrix3d columns_of(const char* key, const Json& value) {
  const std::vector<Eigen::Vector3d> axes = vectors_of(key, value);
  if (axes.size() != 3) refuse(key, "three axes are wanted", value);
  Eigen::Matrix3d m;
  m << axes[0], axes[1], axes[2];
  return m;
}

SlabVector slabs_of(const char* key, const Json& value) {
  if (list_of(key, value).size() > KdopSet::max_size) refuse(key, "at most 49 numbers are wanted", value);
  SlabVector slabs(static_cast<Eigen::Index>(value.size()));
  for (std::size_t i = 0; i < value.size(); ++i)
    slabs[static_cast<Eigen::Index>(i)] = number_of(key, value[i]);
  return slabs;
}

std::int32_t vertex_of(const Json& value, std::size_t vertices) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= vertices)
    refuse("faces", "numbers of vertices are wanted", value);
  return value.get<std::int32_t>();
}

Hull read_hull(const Json& json) {
  std::vector<Eigen::Vector3d> vertices = vectors_of("vertices", member(json, "vertices"));
  std::vector<Hull::Triangle> faces;
  for (const Json& face : list_of("faces", member(json, "faces"))) {
    if (!face.is_array() || face.size() != 3) refuse("faces", "three numbers of vertices are wanted", face);
    const auto vertex = [&](std::size_t i) { return vertex_of(face[i], vertices.size()); };
    faces.push_back({vertex(0), vertex(1), vertex(2)});
  }
  std::vector<HullPlane> planes;
  for (const Json& plane : list_of("planes", member(json, "planes"))) {
    if (!plane.is_array() || plane.size() != 4) refuse("planes", "four numbers are wanted", plane);
    const auto number = [&](std::size_t i) { return number_of("planes", plane[i]); };
    planes.push_back({{number(0), number(1), number(2)}, number(3)});
  }
  int rank = 3;
  if (const auto stored = json.find("rank"); stored != json.end()) {
    if (!stored->is_number_unsigned() || stored->get<std::uint64_t>() > 3)
      refuse("rank", "0, 1, 2 or 3 is wanted", *stored);
    rank = stored->get<int>();
  }
  return {std::move(vertices), std::move(faces), std::move(planes), rank};
}

std::vector<Eigen::Vector2d> outline_of(const Json& value) {
  std::vector<Eigen::Vector2d> outline;
  for (const Json& corner : list_of("outline", value)) {
    if (!corner.is_array() || corner.size() != 2) refuse("outline", "two numbers are wanted", corner);
    outline.emplace_back(number_of("outline", corner[0]), number_of("outline", corner[1]));
  }
  return outline;
}

AnyVolume read_shape(const Json& json) {
  const Json& name = member(json, "shape");
  const auto point = [&](const char* key) { return vector_of(key, member(json, key)); };
  const auto number = [&](const char* key) { return number_of(key, member(json, key)); };
  const auto axes = [&](const char* key) { return columns_of(key, member(json, key)); };
  const auto slabs = [&](const char* key) { return slabs_of(key, member(json, key)); };
  const std::string shape = name.is_string() ? name.get<std::string>() : std::string();
  if (shape == "aabb") return Aabb(point("min"), point("max"));
  if (shape == "kdop") {
    auto set = std::make_shared<const KdopSet>(vectors_of("directions", member(json, "directions")));
    return Kdop(std::move(set), slabs("min"), slabs("max"));
  }
  if (shape == "sphere") return Sphere(point("center"), number("radius"));
  if (shape == "obb") return Obb(point("center"), axes("axes"), point("half_extents"));
  if (shape == "cylinder")
    return Cylinder(point("center"), point("axis"), number("radius"), number("half_height"));
  if (shape == "capsule") return Capsule(point("a"), point("b"), number("radius"));
  if (shape == "ellipsoid") return Ellipsoid(point("center"), axes("axes"), point("radii"));
  if (shape == "hull") return read_hull(json);
  if (shape == "prism")
    return Prism(axes("axes"), outline_of(member(json, "outline")), number("low"), number("high"));
  refuse(abbreviated(name) + " is no shape");
}

// The path of an entry, such as "clusters[0].volumes[2]".
struct EntryPath {
  const EntryPath* parent;  // null for the top level
  std::string key;          // empty for an entry of a list, which has a number instead
  std::size_t number = 0;

  std::string text() const {
    const std::string before = parent == nullptr ? std::string() : parent->text();
    if (key.empty()) return before + '[' + std::to_string(number) + ']';
    return before + (before.empty() ? "" : ".") + key;
  }
};

enum class Found : std::uint8_t { nothing, volumes, volume };

void read_volume(const Json& json, std::vector<AnyVolume>& volumes) {
  if (const auto failed = json.find("failed"); failed != json.end())
    refuse("is no volume: its fit failed, " + abbreviated(*failed));
  if (const auto is_empty = json.find("empty"); is_empty != json.end()) {
    if (!is_empty->is_boolean()) refuse("empty", "true or false is wanted", *is_empty);
    if (is_empty->get<bool>()) return;
  }
  AnyVolume volume = read_shape(json);
  if (empty(volume)) refuse("the volume is empty; an empty volume must have \"empty\": true");
  volumes.push_back(std::move(volume));
}

// Throws the error for an entry that should be a volume but is not.
[[noreturn]] void refuse_entry(const Json& entry, const EntryPath& path) {
  refuse(path.text() + ": is no volume: " + (entry.is_object() ? "it has no \"shape\"" : abbreviated(entry)));
}

// Appends all volumes in a JSON value. Throws an error for an entry that may have been meant as a volume but
// has none, because skipping this entry silently would be unsafe. read_volumes.h lists these entries.
Found collect(const Json& json, const EntryPath* path, std::vector<AnyVolume>& volumes) {
  if (json.is_object() && json.contains("shape")) {
    try {
      read_volume(json, volumes);
    } catch (const std::invalid_argument& error) {
      if (path == nullptr) throw;
      refuse(path->text() + ": " + error.what());
    }
    return Found::volume;
  }
  const bool must_have_volumes = path != nullptr && path->key == "volumes";
  if (!json.is_structured()) {
    if (must_have_volumes) refuse_entry(json, *path);
    return Found::nothing;
  }
  std::vector<Found> found;
  for (const auto& [key, value] : json.items()) {
    const EntryPath inner{path, json.is_object() ? key : std::string(), found.size()};
    found.push_back(collect(value, &inner, volumes));
  }
  const auto count = [&](Found what) { return std::count(found.begin(), found.end(), what); };
  if (must_have_volumes || count(Found::volume) > 0) {
    std::size_t i = 0;
    for (const auto& [key, value] : json.items()) {
      const bool must = must_have_volumes || json.is_array() || value.is_object();
      if (must && found[i] == Found::nothing)
        refuse_entry(value, {path, json.is_object() ? key : std::string(), i});
      ++i;
    }
  }
  return count(Found::nothing) == static_cast<std::ptrdiff_t>(found.size()) ? Found::nothing : Found::volumes;
}

std::vector<AnyVolume> volumes_in(std::string_view text) {
  std::vector<AnyVolume> volumes;
  if (has_kitti_labels(text)) {
    volumes = read_kitti_labels(text);
    if (volumes.empty()) throw IoError("no volumes in it");
    return volumes;
  }
  std::optional<std::size_t> first_without_volume;  // position of the first value without volumes
  // Whether a value of the text is itself a volume. Then all values must have volumes.
  bool has_top_level_volume = false;
  const auto refuse_value = [&](std::size_t at, const std::string& what) {
    std::size_t end = 0;
    next_json_value(text, end);
    const bool alone = next_json_value(text, end).empty();
    throw IoError((alone ? "" : position_in(text, at) + ": ") + what);
  };
  for (std::size_t at = 0;;) {
    const std::size_t begin = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
    const std::optional<Json> json = read_next_json(text, at);
    if (!json) break;
    try {
      const bool labels = read_box_labels(*json, volumes);
      const Found found = labels ? Found::volumes : collect(*json, nullptr, volumes);
      has_top_level_volume = has_top_level_volume || found == Found::volume;
      if (found == Found::nothing && !first_without_volume) first_without_volume = begin;
    } catch (const std::invalid_argument& error) {
      refuse_value(begin, error.what());
    }
  }
  if (has_top_level_volume && first_without_volume)
    refuse_value(*first_without_volume, "is no volume: it has no \"shape\"");
  if (volumes.empty()) throw IoError("no volumes in it");
  return volumes;
}

VolumeEntry read_entry(const Json& json) {
  VolumeEntry entry;
  entry.method = member(json, "method").get<std::string>();
  if (const auto outside = json.find("outside"); outside != json.end())
    entry.outside = outside->get<std::size_t>();
  if (const auto failed = json.find("failed"); failed != json.end()) {
    entry.failed = failed->get<std::string>();
    return entry;
  }
  std::vector<AnyVolume> volumes;
  read_volume(json, volumes);
  if (!volumes.empty()) entry.volume = std::move(volumes.front());
  return entry;
}

}  // namespace

ClusterEntry read_cluster_json(std::string_view text) {
  try {
    const Json json = read_json(text);
    ClusterEntry cluster;
    cluster.id = member(json, "id").get<std::size_t>();
    cluster.points = member(json, "points").get<std::size_t>();
    if (const auto value = json.find("class"); value != json.end())
      cluster.class_value = value->get<std::int64_t>();
    for (const Json& entry : list_of("volumes", member(json, "volumes")))
      cluster.volumes.push_back(read_entry(entry));
    return cluster;
  } catch (const Json::exception&) {
    throw IoError("is no cluster with volumes");
  } catch (const std::invalid_argument& error) {
    throw IoError(error.what());
  }
}

std::vector<AnyVolume> read_volumes(const std::filesystem::path& file) {
  try {
    return volumes_in(read_untrusted_text(file, kMaxVolumesBytes));
  } catch (const IoError& error) {
    throw IoError(message_line(file.string() + ": " + error.what()));
  }
}

}  // namespace pcl_bv::detail
