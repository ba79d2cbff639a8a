// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The tiles of a tileset of 3D Tiles, and where their bounding volumes are in the text of the file.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geographic_region.h"
#include "tile_content.h"

namespace pcl_bv::detail {

enum class BoundKind : std::uint8_t { box, sphere, region, other };

/// A bounding volume in the file.
struct TileVolume {
  BoundKind kind = BoundKind::other;
  std::string_view numbers;  ///< Its list of numbers, in the text of the file.
  std::string text;          ///< The new list; empty if the old one stays.
};

/// Encloses the contents of a tile and its descendants, in the frame of the tile; may be empty.
struct TileBound {
  bool boxed = true;                     ///< Whether the box is known. It is not for old regions.
  std::vector<Eigen::Vector3d> corners;  ///< Of a box.
  std::optional<GeographicRegion> region;
};

struct TileContent {
  std::string uri;
  std::optional<TileVolume> volume;  ///< content.boundingVolume.
};

struct Tile {
  TileVolume volume;
  Eigen::Matrix4d to_parent = Eigen::Matrix4d::Identity(), to_root = Eigen::Matrix4d::Identity();
  std::size_t depth = 0;
  std::vector<std::size_t> children;
  std::vector<TileContent> contents;
  TileBound bound;            ///< At first that of the old volume.
  bool has_metadata = false;  ///< Of the tile or of a content.
  std::string problem;        ///< Why the volume stays; empty if there is no reason.
};

/// The root is the first tile, and children come after their parents.
class TileTree {
 public:
  /// Throws IoError or std::invalid_argument if the file is no tileset, or has a key that gives its
  /// coordinates another meaning and is not known here.
  explicit TileTree(const std::filesystem::path& file);

  std::vector<Tile>& tiles() { return tiles_; }
  const std::vector<Tile>& tiles() const { return tiles_; }
  /// The axis of glTF contents that is z in the tile.
  UpAxis up_axis() const { return up_axis_; }
  /// Returns whether a tile or a content has a region.
  bool has_regions() const { return regions_; }
  /// Returns the text of the file with the new volumes, in pieces.
  std::vector<std::string_view> pieces() const;

 private:
  void read_asset(std::string_view asset);
  std::size_t add_tile(std::string_view json, std::size_t depth, const Eigen::Matrix4d& parent_to_root);

  std::string text_;
  std::vector<Tile> tiles_;
  UpAxis up_axis_ = UpAxis::y;
  bool regions_ = false;
  bool metadata_has_volumes_ = false;
};

/// Returns the bound of a volume, whose list of numbers is JSON. Throws std::invalid_argument for a wrong
/// list.
TileBound bound_of(BoundKind kind, std::string_view numbers);

/// Returns the corners of a box with half axes, as columns.
std::vector<Eigen::Vector3d> corners_of(const Eigen::Vector3d& center, const Eigen::Matrix3d& half_axes);

}  // namespace pcl_bv::detail
