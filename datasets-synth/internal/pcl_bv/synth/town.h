// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A map of a town, without a sensor: terrain, roads, houses, trees, poles, fences, walls, hedges and parked
// cars, cut into square tiles.
//
// x is east, y north, z up, metres. The town begins at (0, 0) and has no end to the east and north. Blocks of
// 74 m x 62 m repeat, so objects lie across borders of tiles. Objects are more than 0.5 m apart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "pcl_bv/synth/street.h"
#include "pcl_bv/synth/synth_cloud.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

inline constexpr double kTownTileMetres = 100;  ///< Side length of a tile.

struct TownOptions {
  std::uint64_t seed = 1;
  /// Approximate mean number of points of a tile with ground. Tiles have up to 30 % more or less, and below
  /// 100 000 points 20 % more, because small models have a minimum number of points. From 200 000 on, a
  /// tolerance of 0.5 m joins all points of an object.
  std::size_t points_per_tile = 200'000;
  bool ground = true;  ///< Whether the cloud has the points of the ground, or those of objects only.
};

/// Position of a tile, from 0, counted from the south-west corner of the town.
struct TownTile {
  std::size_t column = 0, row = 0;
  bool operator==(const TownTile& other) const = default;
};

/// Returns the tile with this number. The first n * n tiles are the square of n columns and n rows, for every
/// n, so the position of a tile does not depend on the number of tiles.
TownTile town_tile(std::size_t number);

/// Returns the name of a tile's file: the column and the row with three digits each, such as "002_013.pcd".
std::string town_file_name(const TownTile& tile);

/// An object of the town.
struct TownObject {
  std::uint32_t id = 0;  ///< >= 1, the same in all tiles.
  SynthObjectKind kind = SynthObjectKind::house;
  std::array<double, 2> min{}, max{};  ///< Box around its points, seen from above.
};

/// A town in which every tile is generated alone. Member functions may be called by several threads.
class Town {
 public:
  /// Samples the models of objects, 0.1 s at 200 000 points a tile. Throws std::invalid_argument unless
  /// points_per_tile is 1000 to 100000000.
  explicit Town(const TownOptions& options);
  ~Town();
  Town(Town&&) noexcept;
  Town& operator=(Town&&) noexcept;

  /// Returns the points of the town in this tile: west and south borders included, the others not. The field
  /// `object` has the id of an object, or 0 for the ground. The same arguments give the same bits (on the
  /// same machine and libm). O(points).
  ///
  /// Coordinates are rounded to float32. The error is at most 0.12 mm up to 4 km from the corner of the town,
  /// and at most 1 mm up to 32 km, the largest extent of 100 000 tiles.
  SynthCloud tile(const TownTile& tile) const;

  /// Returns all objects whose boxes meet the tile, by ascending id.
  std::vector<TownObject> objects(const TownTile& tile) const;

 private:
  struct Models;
  TownOptions options_;
  std::unique_ptr<const Models> models_;
};

/// A town and its number of tiles.
struct TownSequence {
  std::size_t tiles = 64;
  TownOptions options;
};

/// Parses "town[:TILES[:SEED[:POINTS]]]" or "town-objects..." (without ground). TILES is 1 to 100000, POINTS,
/// of a tile, 1000 to 100000000. Throws std::invalid_argument for another text.
TownSequence parse_town(const std::string& text);

/// Returns whether the text begins as those of parse_town().
bool is_town(const std::string& text);

}  // namespace detail
}  // namespace pcl_bv
