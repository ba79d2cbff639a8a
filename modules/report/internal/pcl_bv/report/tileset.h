// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// 3D Tiles 1.1: clusters as a tileset, and new bounding volumes for the tiles of a tileset.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/report/report.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// What the coordinates of a tileset's points are.
enum class TileFrame : std::uint8_t {
  cartesian,  ///< Any frame and unit.
  geographic  ///< x is the longitude and y the latitude in degrees, z the height in metres above WGS84.
};

/// Writes a tileset with a tile for each cluster, without content. Writes nothing for a failed report.
/// - cartesian: a `box` or `sphere` for the first box or sphere of the cluster, in the frame and unit of the
///   points. The root is the box along the axes around all of them.
/// - geographic: a `region` for the first Aabb of the cluster, in radians. It is rounded outwards, so that it
///   encloses the box in exact arithmetic. It ends at the doubles nearest to the 180th meridian and the
///   poles, because validators of tilesets allow no more: points there are up to 2^-52 outside.
/// Clusters without such a volume are left out.
///
/// Throws IoError before the first text if geographic coordinates are beyond 180 or 90 degrees.
void write_tileset(const Report& report, const ClusterSource& clusters, TileFrame frame,
                   const TextSink& take);

struct TilesetUpdate {
  std::size_t tiles = 0, updated = 0;
  /// One line for each tile that keeps its volume although it has content.
  std::vector<std::string> problems;
};

/// Replaces the bounding volumes of a tileset in its file, atomically. All other bytes of the file stay.
///
/// A new volume encloses the contents of the tile and of its descendants. It has the kind of the old one:
/// - box: the box of smallest volume among `boxes`, fitted to the contents and to the corners of the
///   children's boxes;
/// - sphere: the smallest sphere around the same points;
/// - region: longitudes, latitudes and heights above WGS84 of all points, whose frame after the transforms of
///   the tiles must be EPSG 4978.
///
/// Contents are files of tile_points(). A tile keeps its volume if it and its descendants have no content, if
/// one of their contents cannot be read, if it has another kind of volume, or if a region would cross the
/// 180th meridian. An external tileset counts with the volume of its tile.
///
/// Throws IoError if the file is no tileset or cannot be written; it is unchanged then.
TilesetUpdate update_tileset(const std::filesystem::path& file, const std::vector<const Method*>& boxes,
                             const Execution& execution);

}  // namespace detail
}  // namespace pcl_bv
