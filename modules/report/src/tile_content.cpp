// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// 3D Tiles 1.0 (pnts, b3dm) and glTF 2.0.

#include "tile_content.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <set>
#include <utility>

#include "json_numbers.h"

namespace pcl_bv::detail {
namespace {

using ContentJson = UntrustedJson;

// Instances of meshes multiply points. A small file must not take all memory: a forest of 1000 equal trees
// has about 50 points for each byte.
constexpr std::size_t kMaxTilePoints = 100'000'000, kAllowedPoints = 1'000'000, kMaxPointsPerByte = 64;
constexpr std::size_t kMaxCount = std::size_t{1} << 40;

template <typename T>
T number_at(std::string_view bytes, std::size_t at) {
  if (bytes.size() < sizeof(T) || at > bytes.size() - sizeof(T)) throw IoError("is cut");
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::string_view part_at(std::string_view bytes, std::size_t at, std::size_t size) {
  if (at > bytes.size() || size > bytes.size() - at) throw IoError("is cut");
  return bytes.substr(at, size);
}

// Returns a member that is a number of bytes or items.
std::size_t count_of(const ContentJson& json, const char* key, std::size_t missing = kMaxCount) {
  const auto found = json.is_object() ? json.find(key) : json.end();
  if (found == json.end() && missing < kMaxCount) return missing;
  const ContentJson& value = member(json, key);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= kMaxCount)
    refuse(key, "a number of items is wanted", value);
  return value.get<std::size_t>();
}

const ContentJson& entry(const ContentJson& json, const char* list, std::size_t index) {
  const ContentJson& entries = list_of(list, member(json, list));
  if (index >= entries.size()) refuse(std::string(list) + ": has no entry " + std::to_string(index));
  return entries[index];
}

// A header of pnts and b3dm: 28 bytes, then the JSON and the numbers of the feature table.
struct FeatureTable {
  explicit FeatureTable(std::string_view content) {
    if (number_at<std::uint32_t>(content, 4) != 1) throw IoError("is not of version 1");
    const std::size_t text = number_at<std::uint32_t>(content, 12),
                      size = number_at<std::uint32_t>(content, 16);
    if (text > 0) json = read_json(part_at(content, 28, text));
    numbers = part_at(content, 28 + text, size);
    end = 28 + text + size + number_at<std::uint32_t>(content, 20) + number_at<std::uint32_t>(content, 24);
  }

  bool has(const char* key) const { return json.is_object() && json.contains(key); }

  // A vector is in the JSON or, with byteOffset, among the numbers.
  Eigen::Vector3d vector(const char* key) const {
    const ContentJson& value = member(json, key);
    if (!value.is_object()) return vector_of(key, value);
    const std::size_t at = count_of(value, "byteOffset");
    const auto number = [&](std::size_t i) {
      return static_cast<double>(number_at<float>(numbers, at + 4 * i));
    };
    return {number(0), number(1), number(2)};
  }

  Eigen::Vector3d center() const {
    return has("RTC_CENTER") ? vector("RTC_CENTER") : Eigen::Vector3d::Zero();
  }

  ContentJson json;
  std::string_view numbers;
  std::size_t end = 0;
};

void append(const Eigen::Vector3d& point, std::vector<double>& points) {
  points.insert(points.end(), point.data(), point.data() + 3);
}

void append_pnts(std::string_view content, std::vector<double>& points) {
  const FeatureTable table(content);
  const std::size_t count = count_of(table.json, "POINTS_LENGTH");
  const Eigen::Vector3d center = table.center();
  const bool quantized = !table.has("POSITION");
  if (table.has("extensions") && table.json["extensions"].contains("3DTILES_draco_point_compression"))
    throw IoError("positions are compressed with Draco");
  const char* const key = quantized ? "POSITION_QUANTIZED" : "POSITION";
  const std::size_t begin = count_of(member(table.json, key), "byteOffset"), size = quantized ? 6 : 12;
  const std::string_view numbers = part_at(table.numbers, begin, count * size);
  points.reserve(3 * count);
  if (quantized) {
    const Eigen::Vector3d offset = table.vector("QUANTIZED_VOLUME_OFFSET"),
                          step = table.vector("QUANTIZED_VOLUME_SCALE") / 65535;
    for (std::size_t at = 0; at < numbers.size(); at += size) {
      std::array<std::uint16_t, 3> p;
      std::memcpy(p.data(), numbers.data() + at, size);
      append(center + offset + Eigen::Vector3d(p[0], p[1], p[2]).cwiseProduct(step), points);
    }
    return;
  }
  for (std::size_t at = 0; at < numbers.size(); at += size) {
    Eigen::Vector3f p;
    std::memcpy(p.data(), numbers.data() + at, size);
    append(center + p.cast<double>(), points);
  }
}

class Glb {
 public:
  Glb(std::string_view file, const Eigen::Vector3d& center, UpAxis up, std::vector<double>& points)
      : max_points_(std::min(kMaxTilePoints, std::max(kAllowedPoints, kMaxPointsPerByte * file.size()))),
        points_(points) {
    to_tile_.topLeftCorner<3, 3>() = turn_from(up);
    to_tile_.topRightCorner<3, 1>() = center;
    if (number_at<std::uint32_t>(file, 4) != 2) throw IoError("is not glTF of version 2");
    const std::size_t text = number_at<std::uint32_t>(file, 12);
    json_ = read_json(part_at(file, 20, text));
    const std::size_t binary = 20 + text;
    if (file.size() >= binary + 8)
      binary_ = part_at(file, binary + 8, number_at<std::uint32_t>(file, binary));
    for (const char* list : {"extensionsRequired", "extensionsUsed"})
      if (json_.contains(list)) require_known_extensions(list);
  }

  void append_scene() {
    if (!json_.contains("nodes")) return;
    visited_.resize(list_of("nodes", json_["nodes"]).size());
    if (json_.contains("meshes")) meshes_.resize(list_of("meshes", json_["meshes"]).size());
    if (json_.contains("animations") && !json_["animations"].empty())
      throw IoError("has animations, which move points");
    const ContentJson& scene = entry(json_, "scenes", count_of(json_, "scene", 0));
    add_children(scene, "nodes", to_tile_);
    points_.reserve(3 * count_);
    for (const auto& [positions, to_tile] : shown_)
      for (const Positions& each : *positions)
        append_positions(each, to_tile);
  }

 private:
  struct Positions {
    std::string_view bytes;
    std::size_t count, stride;
  };

  // Returns the rotation that makes an axis of glTF the z axis, as viewers of 3D Tiles have it.
  static Eigen::Matrix3d turn_from(UpAxis up) {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    if (up == UpAxis::y) turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    if (up == UpAxis::x) turn << 0, 0, -1, 0, 1, 0, 1, 0, 0;
    return turn;
  }

  // Extensions that do not move vertices.
  void require_known_extensions(const char* list) const {
    for (const ContentJson& extension : list_of(list, json_[list])) {
      const std::string name = extension.is_string() ? extension.get<std::string>() : std::string();
      bool known = false;
      for (const char* start : {"KHR_materials_", "KHR_texture_", "KHR_lights_", "KHR_xmp", "EXT_texture_",
                                "EXT_mesh_features", "EXT_structural_metadata", "EXT_instance_features"})
        known = known || name.starts_with(start);
      if (!known) throw IoError("has the extension " + abbreviated(extension) + ", which may move points");
    }
  }

  void add_children(const ContentJson& parent, const char* key, const Eigen::Matrix4d& to_tile) {
    if (!parent.contains(key)) return;
    for (const ContentJson& child : list_of(key, parent[key])) {
      if (!child.is_number_unsigned() || child.get<std::uint64_t>() >= visited_.size())
        refuse(key, "numbers of nodes are wanted", child);
      const auto node = child.get<std::size_t>();
      if (std::exchange(visited_[node], 1) != 0) refuse("nodes: a node has two parents");
      add_node(json_["nodes"][node], to_tile);
    }
  }

  void add_node(const ContentJson& node, const Eigen::Matrix4d& to_tile) {
    if (++depth_ > 256) refuse("nodes: nested more than 256 deep");
    const Eigen::Matrix4d transform = to_tile * matrix_of(node);
    if (node.contains("skin")) throw IoError("has a skin, which moves points");
    if (node.contains("weights")) throw IoError("has morph targets, which move points");
    if (node.contains("mesh")) add_mesh(count_of(node, "mesh"), transform);
    add_children(node, "children", transform);
    --depth_;
  }

  static Eigen::Matrix4d matrix_of(const ContentJson& node) {
    if (node.contains("matrix")) return column_major("matrix", node["matrix"]);
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    if (node.contains("translation")) transform.translate(vector_of("translation", node["translation"]));
    if (node.contains("rotation")) {
      const ContentJson& q = node["rotation"];  // x, y, z, w
      if (!q.is_array() || q.size() != 4) refuse("rotation", "four numbers are wanted", q);
      const auto at = [&](std::size_t i) { return number_of("rotation", q[i]); };
      transform.rotate(Eigen::Quaterniond(at(3), at(0), at(1), at(2)).normalized());
    }
    if (node.contains("scale")) transform.scale(vector_of("scale", node["scale"]));
    return transform.matrix();
  }

  // Returns the positions of a mesh's primitives. Many primitives often share one accessor, which is returned
  // once: nodes x primitives could be billions in a small file.
  const std::vector<Positions>& positions_of(std::size_t mesh) {
    const ContentJson& found = entry(json_, "meshes", mesh);
    if (meshes_[mesh]) return *meshes_[mesh];
    if (found.contains("weights")) throw IoError("has morph targets, which move points");
    std::set<std::size_t> known;
    std::vector<Positions> all;
    for (const ContentJson& primitive : list_of("primitives", member(found, "primitives"))) {
      const std::size_t accessor = count_of(member(primitive, "attributes"), "POSITION");
      if (!known.insert(accessor).second) continue;
      if (const Positions positions = positions_in(accessor); positions.count > 0) all.push_back(positions);
    }
    return meshes_[mesh].emplace(std::move(all));
  }

  Positions positions_in(std::size_t index) const {
    const ContentJson& accessor = entry(json_, "accessors", index);
    if (accessor.contains("sparse")) throw IoError("has sparse positions");
    if (member(accessor, "componentType") != 5126 || member(accessor, "type") != "VEC3")
      throw IoError("positions are not three floats");
    const ContentJson& view = entry(json_, "bufferViews", count_of(accessor, "bufferView"));
    if (count_of(view, "buffer") != 0 || entry(json_, "buffers", 0).contains("uri"))
      throw IoError("positions are in another file");
    const std::size_t count = count_of(accessor, "count"), stride = count_of(view, "byteStride", 12);
    const std::size_t begin = count_of(accessor, "byteOffset", 0);
    const std::string_view bytes =
        part_at(binary_, count_of(view, "byteOffset", 0), count_of(view, "byteLength"));
    if (stride < 12 || stride > 252) refuse("byteStride: 12 to 252 is wanted");
    if (count == 0) return {bytes, 0, stride};
    return {part_at(bytes, begin, (count - 1) * stride + 12), count, stride};
  }

  // Counts the points before any memory is taken for them.
  void add_mesh(std::size_t mesh, const Eigen::Matrix4d& to_tile) {
    for (const Positions& positions : positions_of(mesh)) {
      if (positions.count > max_points_ - count_)
        throw IoError("its nodes show more than " + std::to_string(max_points_) +
                      " points, the limit for a file of this size");
      count_ += positions.count;
    }
    shown_.emplace_back(&positions_of(mesh), to_tile);
  }

  void append_positions(const Positions& positions, const Eigen::Matrix4d& to_tile) {
    for (std::size_t i = 0; i < positions.count; ++i) {
      Eigen::Vector3f p;
      std::memcpy(p.data(), positions.bytes.data() + i * positions.stride, 12);
      append((to_tile * p.cast<double>().homogeneous()).head<3>(), points_);
    }
  }

  Eigen::Matrix4d to_tile_ = Eigen::Matrix4d::Identity();
  std::size_t max_points_;
  std::vector<double>& points_;
  ContentJson json_;
  std::string_view binary_;
  std::vector<std::optional<std::vector<Positions>>> meshes_;
  std::vector<std::pair<const std::vector<Positions>*, Eigen::Matrix4d>> shown_;  // meshes in the scene
  std::size_t count_ = 0;                                                         // of their points
  std::vector<char> visited_;  // not bool, which has no references
  int depth_ = 0;
};

}  // namespace

Eigen::Matrix4d column_major(const char* key, const UntrustedJson& value) {
  if (!value.is_array() || value.size() != 16) refuse(key, "16 numbers are wanted", value);
  Eigen::Matrix4d matrix;
  for (std::size_t i = 0; i < 16; ++i)
    matrix.data()[i] = number_of(key, value[i]);
  return matrix;
}

std::vector<double> tile_points(std::string_view content, UpAxis up) {
  std::vector<double> points;
  try {
    const std::string_view magic = content.substr(0, 4);
    if (magic == "pnts") {
      append_pnts(content, points);
    } else if (magic == "glTF") {
      Glb(content, Eigen::Vector3d::Zero(), up, points).append_scene();
    } else if (magic == "b3dm") {
      const FeatureTable table(content);
      Glb(part_at(content, table.end, content.size() - std::min(content.size(), table.end)), table.center(),
          up, points)
          .append_scene();
    } else {
      throw IoError("is no .pnts, .glb or .b3dm file");
    }
  } catch (const std::invalid_argument& error) {
    throw IoError(error.what());
  }
  return points;
}

}  // namespace pcl_bv::detail
