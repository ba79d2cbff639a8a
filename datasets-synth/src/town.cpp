// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/synth/town.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "town_layout.h"

namespace pcl_bv::detail {
namespace {

// A tile with ground has kSurface / spacing^2 points, on average over 64 tiles: its visible surface in square
// metres, with thin models weighted by their finer sampling.
constexpr double kSurface = 19'500;
constexpr double kGroundNoise = 0.02;  // largest random displacement of the ground in z, metres

double spacing_of(const TownOptions& options) {
  return std::sqrt(kSurface / static_cast<double>(options.points_per_tile));
}

TownArea area_of(const TownTile& tile) {
  const double x = kTownTileMetres * static_cast<double>(tile.column),
               y = kTownTileMetres * static_cast<double>(tile.row);
  return {x, y, x + kTownTileMetres, y + kTownTileMetres};
}

/// The hills of a tile, interpolated bilinearly between heights 1 m apart. The error is below 0.1 mm.
class TileHills {
 public:
  TileHills(const TownTerrain& terrain, const TownArea& area) : area_(area), heights_(kNodes * kNodes) {
    for (std::size_t i = 0; i < kNodes; ++i)
      for (std::size_t k = 0; k < kNodes; ++k)
        heights_[i * kNodes + k] =
            terrain.hills(area.low_x + static_cast<double>(i), area.low_y + static_cast<double>(k));
  }

  /// Returns the height at a point of the area.
  double at(double x, double y) const {
    const double u = x - area_.low_x, v = y - area_.low_y;
    const auto i = static_cast<std::size_t>(u), k = static_cast<std::size_t>(v);
    const double s = u - static_cast<double>(i), t = v - static_cast<double>(k);
    const double* const node = heights_.data() + i * kNodes + k;
    const double west = node[0] + t * (node[1] - node[0]),
                 east = node[kNodes] + t * (node[kNodes + 1] - node[kNodes]);
    return west + s * (east - west);
  }

 private:
  static constexpr auto kNodes = static_cast<std::size_t>(kTownTileMetres) + 2;
  TownArea area_;
  std::vector<double> heights_;
};

/// Three numbers uniform in [-1, 1), of 21 bits each.
struct Triple {
  double x, y, z;
  explicit Triple(std::uint64_t bits) : x(part(bits)), y(part(bits >> 21)), z(part(bits >> 42)) {}
  static double part(std::uint64_t bits) {
    return static_cast<double>(static_cast<std::int32_t>(bits & 0x1fffff) - 0x100000) * 0x1p-20;
  }
};

class TileBuilder {
 public:
  TileBuilder(const TownOptions& options, const TownTile& tile)
      : options_(options),
        area_(area_of(tile)),
        terrain_(options.seed),
        hills_(terrain_, area_),
        tile_(tile) {
    cloud_.xyz.reserve(4 * options.points_per_tile);
    cloud_.object.reserve(4 * options.points_per_tile / 3);
  }

  SynthCloud build(const TownModels& models) {
    const std::vector<TownInstance> objects = place_town_objects(options_.seed, terrain_, models, area_);
    if (options_.ground) add_ground(objects);
    for (const TownInstance& object : objects)
      add(object);
    return std::move(cloud_);
  }

 private:
  // Rounded coordinates decide in which tile a point is, so each point is in exactly one.
  void add_point(double x, double y, double z, std::uint32_t object) {
    const auto px = static_cast<float>(x), py = static_cast<float>(y);
    if (!(px >= area_.low_x && px < area_.high_x && py >= area_.low_y && py < area_.high_y)) return;
    if (object != 0 && z < hills_.at(px, py) - TownTerrain::road_depth(px, py)) return;  // underground
    cloud_.xyz.push_back(px);
    cloud_.xyz.push_back(py);
    cloud_.xyz.push_back(static_cast<float>(z));
    cloud_.object.push_back(object);
  }

  // One point in each cell of a grid, except below houses.
  void add_ground(const std::vector<TownInstance>& objects) {
    const auto side = static_cast<std::size_t>(std::ceil(kTownTileMetres / spacing_of(options_)));
    const double cell = kTownTileMetres / static_cast<double>(side);
    const std::vector<bool> covered = cells_below_houses(objects, side, cell);
    SplitMix64 random({options_.seed, 4, tile_.column, tile_.row});
    for (std::size_t i = 0; i < side; ++i) {
      const double x = area_.low_x + cell * (static_cast<double>(i) + 0.5);
      for (std::size_t k = 0; k < side; ++k) {
        const Triple jitter(random.next());
        if (covered[i * side + k]) continue;
        const double at_x = x + 0.3 * cell * jitter.x,
                     at_y = area_.low_y + cell * (static_cast<double>(k) + 0.5 + 0.3 * jitter.y);
        const double depth = TownTerrain::road_depth(at_x, at_y);
        add_point(at_x, at_y, hills_.at(at_x, at_y) - depth + kGroundNoise * jitter.z, 0);
      }
    }
  }

  std::vector<bool> cells_below_houses(const std::vector<TownInstance>& objects, std::size_t side,
                                       double cell) const {
    std::vector<bool> covered(side * side);
    const auto index = [&](double metres) {  // of the first cell whose middle is not below
      return static_cast<std::size_t>(
          std::ceil(std::clamp(metres / cell - 0.5, 0.0, static_cast<double>(side))));
    };
    for (const TownInstance& object : objects) {
      if (object.model->kind != SynthObjectKind::house) continue;
      const std::size_t end_x = index(object.high_x - area_.low_x),
                        end_y = index(object.high_y - area_.low_y);
      for (std::size_t i = index(object.low_x - area_.low_x); i < end_x; ++i)
        for (std::size_t k = index(object.low_y - area_.low_y); k < end_y; ++k)
          covered[i * side + k] = true;
    }
    return covered;
  }

  // Draws the same numbers in every tile, so that the tiles of an object fit together.
  void add(const TownInstance& object) {
    SplitMix64 random({options_.seed, 5, object.id});
    for (const Vec3& point : object.model->points) {
      const Triple noise(random.next());
      const double east = object.cosine * point.x - object.sine * point.y,
                   north = object.sine * point.x + object.cosine * point.y;
      add_point(
          object.x + east + kTownNoise * noise.x, object.y + north + kTownNoise * noise.y,
          object.z + point.z + object.slope_east * east + object.slope_north * north + kTownNoise * noise.z,
          object.id);
    }
  }

  const TownOptions& options_;
  TownArea area_;
  TownTerrain terrain_;
  TileHills hills_;
  TownTile tile_;
  SynthCloud cloud_;
};

}  // namespace

struct Town::Models {
  TownModels all;
};

TownTile town_tile(std::size_t number) {
  auto n = static_cast<std::size_t>(std::sqrt(static_cast<double>(number)));
  while (n * n > number)
    --n;
  while ((n + 1) * (n + 1) <= number)
    ++n;
  // The n * n tiles before are a square. A new column goes up, then a new row goes east to the corner.
  const std::size_t rest = number - n * n;
  return rest <= n ? TownTile{n, rest} : TownTile{rest - n - 1, n};
}

std::string town_file_name(const TownTile& tile) {
  const auto padded = [](std::size_t value) {
    const std::string digits = std::to_string(value);
    return std::string(digits.size() < 3 ? 3 - digits.size() : 0, '0') + digits;
  };
  return padded(tile.column) + '_' + padded(tile.row) + ".pcd";
}

Town::Town(const TownOptions& options) : options_(options) {
  if (options.points_per_tile < 1000 || options.points_per_tile > 100'000'000)
    throw std::invalid_argument("town: points_per_tile is " + std::to_string(options.points_per_tile) +
                                ", must be 1000 to 100000000");
  models_ = std::make_unique<const Models>(Models{sample_town_models(options.seed, spacing_of(options))});
}

Town::~Town() = default;
Town::Town(Town&&) noexcept = default;
Town& Town::operator=(Town&&) noexcept = default;

SynthCloud Town::tile(const TownTile& tile) const {
  return TileBuilder(options_, tile).build(models_->all);
}

std::vector<TownObject> Town::objects(const TownTile& tile) const {
  std::vector<TownObject> objects;
  for (const TownInstance& object :
       place_town_objects(options_.seed, TownTerrain(options_.seed), models_->all, area_of(tile)))
    objects.push_back(
        {object.id, object.model->kind, {object.low_x, object.low_y}, {object.high_x, object.high_y}});
  return objects;
}

}  // namespace pcl_bv::detail
