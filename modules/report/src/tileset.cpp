// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The file is not parsed and written again, which would lose its order of keys and its numbers' digits: only
// the texts of the bounding volumes are replaced.

#include "pcl_bv/report/tileset.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <functional>
#include <map>
#include <optional>

#include "geographic_region.h"
#include "json_numbers.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "tile_content.h"
#include "tile_volumes.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kMaxContentBytes = std::size_t{1} << 30;

enum class BoundKind : std::uint8_t { box, sphere, region, other };

struct TileBound {
  bool boxed = true;                     ///< Whether the box is known. It is not for old regions.
  std::vector<Eigen::Vector3d> corners;  ///< Of a box around all contents, in the frame of the tile.
  std::optional<GeographicRegion> region;
};

struct Tile {
  std::string_view volume;  ///< The text of its bounding volume in the file.
  BoundKind kind = BoundKind::other;
  Eigen::Matrix4d to_parent = Eigen::Matrix4d::Identity(), to_root = Eigen::Matrix4d::Identity();
  std::size_t depth = 0;
  std::vector<std::size_t> children;
  std::vector<std::string> contents;
  TileBound bound;   ///< Encloses the contents of the tile and its descendants; may be empty.
  std::string text;  ///< The new volume; empty if the old one stays.
  std::string problem;
};

// Calls each(key, value) for the members of an object, or with empty keys for the entries of a list.
template <typename Each>
void for_each_value(std::string_view json, const Each& each) {
  const bool object = json.front() == '{';
  for (std::size_t at = 1;;) {
    at = json.find_first_not_of(" \t\r\n,", at);
    if (at == std::string_view::npos || json[at] == '}' || json[at] == ']') return;
    std::string_view key;
    if (object) {
      key = next_json_value(json, at);
      at = json.find(':', at) + 1;
    }
    each(key, next_json_value(json, at));
  }
}

Eigen::Vector3d three(const UntrustedJson& numbers, std::size_t first) {
  return {number_of("box", numbers[first]), number_of("box", numbers[first + 1]),
          number_of("box", numbers[first + 2])};
}

// Corners of a box with half axes, as columns.
std::vector<Eigen::Vector3d> corners_of(const Eigen::Vector3d& center, const Eigen::Matrix3d& half_axes) {
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    const auto sign = [&](int bit) { return (i >> bit & 1) != 0 ? 1.0 : -1.0; };
    corners.emplace_back(center + half_axes * Eigen::Vector3d(sign(0), sign(1), sign(2)));
  }
  return corners;
}

// Reads the old volume: its kind, and its bound for the parent in case that the contents cannot be read.
void read_old_volume(Tile& tile) {
  const UntrustedJson json = read_json(tile.volume);
  const auto numbers = [&](const char* key, std::size_t count) -> const UntrustedJson* {
    const auto found = json.is_object() ? json.find(key) : json.end();
    if (found == json.end()) return nullptr;
    if (!found->is_array() || found->size() != count)
      refuse(key, (std::to_string(count) + " numbers are wanted").c_str(), *found);
    return &*found;
  };
  if (const UntrustedJson* box = numbers("box", 12)) {
    tile.kind = BoundKind::box;
    Eigen::Matrix3d half_axes;
    half_axes << three(*box, 3), three(*box, 6), three(*box, 9);
    tile.bound.corners = corners_of(three(*box, 0), half_axes);
  } else if (const UntrustedJson* sphere = numbers("sphere", 4)) {
    tile.kind = BoundKind::sphere;
    const double radius = number_of("sphere", (*sphere)[3]);
    tile.bound.corners = corners_of(three(*sphere, 0), radius * Eigen::Matrix3d::Identity());
  } else if (const UntrustedJson* region = numbers("region", 6)) {
    tile.kind = BoundKind::region;
    std::array<double, 6> six{};
    for (std::size_t i = 0; i < 6; ++i)
      six[i] = number_of("region", (*region)[i]);
    tile.bound.region.emplace(six);
  }
}

void add_content(std::string_view json, Tile& tile) {
  const UntrustedJson content = read_json(json);
  const UntrustedJson& uri = content.contains("url") ? content["url"] : member(content, "uri");  // url: 0.0
  if (!uri.is_string()) refuse("uri", "a text is wanted", uri);
  tile.contents.push_back(uri.get<std::string>());
}

class Tileset {
 public:
  explicit Tileset(const std::filesystem::path& file) : folder_(file.parent_path()) {
    text_ = read_untrusted_text(file, kMaxVolumesBytes);
    static_cast<void>(read_json(text_));  // only valid JSON can be searched for values
    std::size_t at = 0;
    const std::string_view all = next_json_value(text_, at);
    std::string_view root;
    if (all.front() == '{')
      for_each_value(all, [&](auto key, auto value) { root = key == "\"root\"" ? value : root; });
    if (root.empty() || root.front() != '{') throw IoError("is no tileset: it has no \"root\"");
    add_tile(root, 0, Eigen::Matrix4d::Identity());
    for (const Tile& tile : tiles_)
      regions_ = regions_ || tile.kind == BoundKind::region;
  }

  // Children come before their parents, which need their bounds.
  void fit(const std::vector<const Method*>& boxes, const Execution& execution) {
    std::map<std::size_t, std::vector<std::size_t>, std::greater<>> by_depth;
    for (std::size_t i = 0; i < tiles_.size(); ++i)
      by_depth[tiles_[i].depth].push_back(i);
    for (const auto& level : by_depth)
      for_each_chunk(execution.parallel, level.second.size(),
                     [&](std::size_t i) { fit_tile(tiles_[level.second[i]], boxes); });
  }

  std::vector<std::string_view> new_pieces() const {
    std::vector<const Tile*> changed;
    for (const Tile& tile : tiles_)
      if (!tile.text.empty()) changed.push_back(&tile);
    std::sort(changed.begin(), changed.end(),
              [](const Tile* a, const Tile* b) { return a->volume.data() < b->volume.data(); });
    std::vector<std::string_view> pieces;
    const char* at = text_.data();
    for (const Tile* tile : changed) {
      pieces.emplace_back(at, static_cast<std::size_t>(tile->volume.data() - at));
      pieces.emplace_back(tile->text);
      at = tile->volume.data() + tile->volume.size();
    }
    pieces.emplace_back(at, static_cast<std::size_t>(text_.data() + text_.size() - at));
    return pieces;
  }

  const std::vector<Tile>& tiles() const { return tiles_; }

 private:
  std::size_t add_tile(std::string_view json, std::size_t depth, const Eigen::Matrix4d& parent_to_root) {
    if (json.front() != '{') throw IoError("is no tileset: a tile is no object");
    Tile tile;
    tile.depth = depth;
    std::string_view children;
    for_each_value(json, [&](std::string_view key, std::string_view value) {
      if (key == "\"boundingVolume\"") tile.volume = value;
      if (key == "\"children\"") children = value;
      if (key == "\"transform\"") tile.to_parent = column_major("transform", read_json(value));
      if (key == "\"content\"") add_content(value, tile);
      if (key == "\"contents\"" && value.front() == '[')
        for_each_value(value, [&](auto, std::string_view content) { add_content(content, tile); });
    });
    if (tile.volume.empty()) throw IoError("is no tileset: a tile has no \"boundingVolume\"");
    tile.to_root = parent_to_root * tile.to_parent;
    read_old_volume(tile);
    const std::size_t number = tiles_.size();
    const Eigen::Matrix4d to_root = tile.to_root;
    tiles_.push_back(std::move(tile));
    if (!children.empty() && children.front() == '[')
      for_each_value(children, [&](auto, std::string_view child) {
        const std::size_t added = add_tile(child, depth + 1, to_root);
        tiles_[number].children.push_back(added);
      });
    return number;
  }

  // Returns the path of a content: without a query, and with %20 as a blank.
  std::filesystem::path path_of(const std::string& uri) const {
    if (uri.find("://") != std::string::npos || uri.starts_with("data:")) throw IoError("is no file");
    std::string path;
    for (std::size_t i = 0; i < std::min(uri.find_first_of("?#"), uri.size()); ++i) {
      unsigned code = 0;
      const bool coded = uri[i] == '%' && i + 2 < uri.size() &&
                         std::from_chars(&uri[i + 1], &uri[i + 3], code, 16).ptr == &uri[i + 3];
      path += coded ? static_cast<char>(code) : uri[i];
      if (coded) i += 2;
    }
    return folder_ / path;
  }

  static bool is_external_tileset(const std::filesystem::path& path) { return path.extension() == ".json"; }

  // Appends the points of all contents. Returns false if an external tileset is among them.
  bool read_contents(Tile& tile, std::vector<double>& points) const {
    for (const std::string& uri : tile.contents) {
      try {
        const std::filesystem::path path = path_of(uri);
        if (is_external_tileset(path)) return false;
        const std::vector<double> some = tile_points(read_untrusted_text(path, kMaxContentBytes));
        points.insert(points.end(), some.begin(), some.end());
      } catch (const IoError& error) {
        throw IoError(uri + ": " + error.what());
      }
    }
    return true;
  }

  void fit_tile(Tile& tile, const std::vector<const Method*>& boxes) {
    try {
      std::vector<double> points;
      if (!read_contents(tile, points)) return;
      TileBound bound;
      if (regions_) bound.region.emplace(points, tile.to_root);
      if (!add_children(tile, points, bound) || points.empty()) return;
      set_volume(tile, points, std::move(bound), boxes);
    } catch (const std::exception& error) {
      tile.problem = error.what();
    }
  }

  // Adds the bounds of the children, in the frame of the tile. Returns false if one of them is unknown.
  bool add_children(const Tile& tile, std::vector<double>& points, TileBound& bound) const {
    for (const std::size_t number : tile.children) {
      const Tile& child = tiles_[number];
      const bool region = tile.kind == BoundKind::region;
      if (region ? !child.bound.region : child.bound.corners.empty()) return false;
      bound.boxed = bound.boxed && !child.bound.corners.empty();
      for (const Eigen::Vector3d& corner : child.bound.corners) {
        const Eigen::Vector3d p = (child.to_parent * corner.homogeneous()).head<3>();
        points.insert(points.end(), p.data(), p.data() + 3);
      }
      if (bound.region && child.bound.region) {
        bound.region->merge(*child.bound.region);
      } else {
        bound.region.reset();
      }
    }
    return true;
  }

  static void set_volume(Tile& tile, const std::vector<double>& points, TileBound bound,
                         const std::vector<const Method*>& boxes) {
    const PointView view = PointView::of(points.data(), 3 * sizeof(double), points.size() / 3);
    Obb box;
    for (const Method* method : boxes) {
      const AnyVolume fitted = *method->fit(view, {}, Execution{Serial{}});
      const Obb* const oriented = std::get_if<Obb>(&fitted);
      const Obb candidate = oriented != nullptr ? *oriented : Obb(std::get<Aabb>(fitted));
      if (box.empty() || candidate.volume() < box.volume()) box = candidate;
    }
    if (box.empty()) throw IoError("its contents have no valid point");
    if (bound.boxed) bound.corners = corners_of(box.center(), box.axes() * box.half_extents().asDiagonal());
    std::string text;
    JsonText json(text);
    if (tile.kind == BoundKind::box) {
      add_tile_volume(box, json);
    } else if (tile.kind == BoundKind::sphere) {
      add_tile_volume(*fit_smallest_sphere(view), json);
    } else if (tile.kind == BoundKind::region && bound.region) {
      json.begin('{').add("region", bound.region->numbers()).end('}');
    } else {
      throw IoError("its bounding volume is no box, sphere or region that can be computed");
    }
    tile.text = std::move(text);
    tile.bound = std::move(bound);
  }

  std::filesystem::path folder_;
  std::string text_;
  std::vector<Tile> tiles_;
  bool regions_ = false;
};

}  // namespace

TilesetUpdate update_tileset(const std::filesystem::path& file, const std::vector<const Method*>& boxes,
                             const Execution& execution) {
  try {
    Tileset tileset(file);
    tileset.fit(boxes, execution);
    TilesetUpdate update;
    update.tiles = tileset.tiles().size();
    for (const Tile& tile : tileset.tiles()) {
      update.updated += tile.text.empty() ? 0 : 1;
      if (!tile.problem.empty()) update.problems.push_back(printable(tile.problem));
    }
    if (update.updated > 0) write_file_atomically(file, tileset.new_pieces());
    return update;
  } catch (const std::invalid_argument& error) {
    throw IoError(error.what());
  }
}

}  // namespace pcl_bv::detail
