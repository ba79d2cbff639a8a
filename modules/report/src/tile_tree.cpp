// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tile_tree.h"

#include <algorithm>
#include <array>
#include <utility>

#include "json_numbers.h"

namespace pcl_bv::detail {
namespace {

// Extensions of tilesets that do not change where contents and volumes are, or that are read below.
constexpr std::string_view kKnownExtensions[]{
    "3DTILES_content_gltf", "3DTILES_multiple_contents",         "3DTILES_implicit_tiling",
    "3DTILES_metadata",     "3DTILES_bounding_volume_S2",        "3DTILES_bounding_volume_cylinder",
    "3DTILES_layer",        "3DTILES_draco_point_compression",   "3DTILES_batch_table_hierarchy",
    "MAXAR_extent",         "3DTILES_bounding_volume_ellipsoid", "MAXAR_grid"};

// Calls each(key, value) for the members of an object, or with empty keys for the entries of a list.
template <typename Each>
void for_each_value(std::string_view json, const Each& each) {
  const bool object = json.front() == '{';
  if (!object && json.front() != '[') return;
  for (std::size_t at = 1;;) {
    at = json.find_first_not_of(" \t\r\n,", at);
    if (at == std::string_view::npos || json[at] == '}' || json[at] == ']') return;
    std::string key;
    if (object) {
      key = read_json(next_json_value(json, at)).get<std::string>();  // may have escapes
      at = json.find(':', at) + 1;
    }
    each(key, next_json_value(json, at));
  }
}

Eigen::Vector3d three(const UntrustedJson& numbers, std::size_t first) {
  return {number_of("box", numbers[first]), number_of("box", numbers[first + 1]),
          number_of("box", numbers[first + 2])};
}

// Reads a volume and its bound. The kind of a volume with several kinds or with extensions is `other`,
// because a new box would contradict the rest.
TileVolume read_volume(std::string_view json, TileBound& bound) {
  TileVolume volume;
  bool several = false;
  for_each_value(json, [&](const std::string& key, std::string_view value) {
    const BoundKind kind = key == "box"      ? BoundKind::box
                           : key == "sphere" ? BoundKind::sphere
                           : key == "region" ? BoundKind::region
                                             : BoundKind::other;
    several = several || key == "extensions" || (kind != BoundKind::other && !volume.numbers.empty());
    if (kind == BoundKind::other || !volume.numbers.empty()) return;
    volume.kind = kind;
    volume.numbers = value;
  });
  bound = bound_of(volume.kind, volume.numbers);
  if (several) volume.kind = BoundKind::other;
  return volume;
}

void add_content(std::string_view json, Tile& tile) {
  if (json.front() != '{') throw IoError("is no tileset: a content is no object");
  TileContent content;
  std::string_view uri;
  for_each_value(json, [&](const std::string& key, std::string_view value) {
    if (key == "uri" || key == "url") uri = value;  // url: version 0.0
    TileBound unused;
    if (key == "boundingVolume") content.volume = read_volume(value, unused);
    tile.has_metadata = tile.has_metadata || key == "metadata";
  });
  if (uri.empty()) refuse("has no \"uri\"");
  const UntrustedJson text = read_json(uri);
  if (!text.is_string()) refuse("uri", "a text is wanted", text);
  content.uri = text.get<std::string>();
  tile.contents.push_back(std::move(content));
}

void add_contents(std::string_view json, Tile& tile) {
  if (json.front() == '[')
    for_each_value(json, [&](const std::string&, std::string_view content) { add_content(content, tile); });
}

void read_tile_extensions(std::string_view json, Tile& tile) {
  for_each_value(json, [&](const std::string& name, std::string_view extension) {
    if (name == "3DTILES_implicit_tiling") tile.problem = "implicit tiling: volumes cannot be computed";
    if (name != "3DTILES_multiple_contents") return;
    for_each_value(extension, [&](const std::string& key, std::string_view value) {
      if (key == "contents" || key == "content") add_contents(value, tile);
    });
  });
}

void require_known_extensions(const char* list, std::string_view json) {
  const UntrustedJson names = read_json(json);
  for (const UntrustedJson& name : list_of(list, names)) {
    const bool known =
        name.is_string() &&
        std::ranges::find(kKnownExtensions, name.get<std::string_view>()) != std::end(kKnownExtensions);
    if (!known) throw IoError("needs the extension " + abbreviated(name) + ", which may move its contents");
  }
}

// Returns whether the metadata of tiles or contents may replace their volumes, transforms or uris.
bool has_semantics_of_tiles(std::string_view schema) {
  constexpr std::string_view semantics[] = {"\"TILE_BOUNDING_", "\"CONTENT_BOUNDING_", "\"TILE_TRANSFORM",
                                            "\"CONTENT_URI"};
  return std::ranges::any_of(
      semantics, [&](std::string_view semantic) { return schema.find(semantic) != std::string_view::npos; });
}

}  // namespace

std::vector<Eigen::Vector3d> corners_of(const Eigen::Vector3d& center, const Eigen::Matrix3d& half_axes) {
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    const auto sign = [&](int bit) { return (i >> bit & 1) != 0 ? 1.0 : -1.0; };
    corners.emplace_back(center + half_axes * Eigen::Vector3d(sign(0), sign(1), sign(2)));
  }
  return corners;
}

TileBound bound_of(BoundKind kind, std::string_view numbers) {
  TileBound bound;
  if (kind == BoundKind::other) return bound;
  constexpr const char* names[]{"box", "sphere", "region"};
  constexpr std::size_t counts[]{12, 4, 6};
  const auto number = static_cast<std::size_t>(kind);
  const UntrustedJson list = read_json(numbers);
  if (!list.is_array() || list.size() != counts[number])
    refuse(names[number], (std::to_string(counts[number]) + " numbers are wanted").c_str(), list);
  if (kind == BoundKind::box) {
    Eigen::Matrix3d half_axes;
    half_axes << three(list, 3), three(list, 6), three(list, 9);
    bound.corners = corners_of(three(list, 0), half_axes);
  } else if (kind == BoundKind::sphere) {
    const double radius = number_of("sphere", list[3]);
    bound.corners = corners_of(three(list, 0), radius * Eigen::Matrix3d::Identity());
  } else {
    std::array<double, 6> six{};
    for (std::size_t i = 0; i < 6; ++i)
      six[i] = number_of("region", list[i]);
    bound.region.emplace(six);
  }
  return bound;
}

TileTree::TileTree(const std::filesystem::path& file) {
  text_ = read_untrusted_text(file, kMaxVolumesBytes);
  std::size_t at = 0;
  const std::string_view all = next_json_value(text_, at);
  // Only valid JSON can be searched for values. read_json() would take 30 times the memory of the text.
  if (!UntrustedJson::accept(text_)) static_cast<void>(read_json(text_));
  std::string_view root;
  for_each_value(all, [&](const std::string& key, std::string_view value) {
    if (key == "root") root = value;
    if (key == "asset") read_asset(value);
    if (key == "extensionsRequired") require_known_extensions("extensionsRequired", value);
    if (key == "schema") metadata_has_volumes_ = metadata_has_volumes_ || has_semantics_of_tiles(value);
    if (key == "schemaUri") metadata_has_volumes_ = true;  // the file of the schema is not read
    if (key == "extensions")
      for_each_value(value, [](const std::string& name, std::string_view) {
        if (name == "3DTILES_ellipsoid") throw IoError("has another ellipsoid than WGS84: 3DTILES_ellipsoid");
      });
  });
  if (root.empty() || root.front() != '{') throw IoError("is no tileset: it has no \"root\"");
  add_tile(root, 0, Eigen::Matrix4d::Identity());
}

void TileTree::read_asset(std::string_view asset) {
  for_each_value(asset, [&](const std::string& key, std::string_view value) {
    if (key != "gltfUpAxis") return;
    const UntrustedJson axis = read_json(value);
    const std::string name = axis.is_string() ? axis.get<std::string>() : std::string();
    if (name == "X" || name == "x") {
      up_axis_ = UpAxis::x;
    } else if (name == "Z" || name == "z") {
      up_axis_ = UpAxis::z;
    } else if (name == "Y" || name == "y") {
      up_axis_ = UpAxis::y;
    } else {
      refuse("gltfUpAxis", "X, Y or Z is wanted", axis);
    }
  });
}

std::size_t TileTree::add_tile(std::string_view json, std::size_t depth,
                               const Eigen::Matrix4d& parent_to_root) {
  if (json.front() != '{') throw IoError("is no tileset: a tile is no object");
  Tile tile;
  tile.depth = depth;
  bool has_volume = false;
  std::string_view children;
  for_each_value(json, [&](const std::string& key, std::string_view value) {
    if (key == "boundingVolume") tile.volume = read_volume(value, tile.bound);
    has_volume = has_volume || key == "boundingVolume";
    tile.has_metadata = tile.has_metadata || key == "metadata";
    if (key == "children") children = value;
    if (key == "transform") tile.to_parent = column_major("transform", read_json(value));
    if (key == "content") add_content(value, tile);
    if (key == "contents") add_contents(value, tile);
    if (key == "extensions") read_tile_extensions(value, tile);
    if (key == "implicitTiling") tile.problem = "implicit tiling: volumes cannot be computed";
  });
  if (!has_volume) throw IoError("is no tileset: a tile has no \"boundingVolume\"");
  if (tile.has_metadata && metadata_has_volumes_)
    tile.problem = "its metadata may replace its volumes, which therefore stay";
  regions_ = regions_ || tile.volume.kind == BoundKind::region;
  for (const TileContent& content : tile.contents)
    regions_ = regions_ || (content.volume && content.volume->kind == BoundKind::region);
  tile.to_root = parent_to_root * tile.to_parent;
  const std::size_t number = tiles_.size();
  const Eigen::Matrix4d to_root = tile.to_root;
  tiles_.push_back(std::move(tile));
  if (!children.empty() && children.front() == '[')
    for_each_value(children, [&](const std::string&, std::string_view child) {
      const std::size_t added = add_tile(child, depth + 1, to_root);
      tiles_[number].children.push_back(added);
    });
  return number;
}

std::vector<std::string_view> TileTree::pieces() const {
  std::vector<const TileVolume*> changed;
  const auto note = [&](const TileVolume& volume) {
    if (!volume.text.empty()) changed.push_back(&volume);
  };
  for (const Tile& tile : tiles_) {
    note(tile.volume);
    for (const TileContent& content : tile.contents)
      if (content.volume) note(*content.volume);
  }
  std::ranges::sort(changed, {}, [](const TileVolume* volume) { return volume->numbers.data(); });
  std::vector<std::string_view> pieces;
  const char* at = text_.data();
  for (const TileVolume* volume : changed) {
    pieces.emplace_back(at, static_cast<std::size_t>(volume->numbers.data() - at));
    pieces.emplace_back(volume->text);
    at = volume->numbers.data() + volume->numbers.size();
  }
  pieces.emplace_back(at, static_cast<std::size_t>(text_.data() + text_.size() - at));
  return pieces;
}

}  // namespace pcl_bv::detail
