// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Terrain of the town, and positions of its objects.
#pragma once

#include <cstdint>
#include <vector>

#include "town_models.h"

namespace pcl_bv::detail {

/// Maximum random displacement of the points of objects along each axis, metres.
inline constexpr double kTownNoise = 0.01;

/// The hills of a town, without the curbs of roads.
class TownTerrain {
 public:
  explicit TownTerrain(std::uint64_t seed);

  /// Returns the height at (x, y), metres. Slopes are at most 6 %.
  double hills(double x, double y) const;

  /// Returns how much lower than the hills the surface is at (x, y): 0.12 m on roads, else 0.
  static double road_depth(double x, double y);

 private:
  double phases_[3];
};

/// A model placed on the terrain. The model's axes are rotated by a multiple of 90 degrees.
struct TownInstance {
  std::uint32_t id = 0;
  const TownModel* model = nullptr;
  double x = 0, y = 0, z = 0;                           ///< Position of the model's origin.
  int cosine = 1, sine = 0;                             ///< Of the rotation about z.
  double slope_east = 0, slope_north = 0;               ///< Tilt: metres up per metre; 0 for upright objects.
  double low_x = 0, low_y = 0, high_x = 0, high_y = 0;  ///< Bounds of the points.
};

/// Bounds of a region seen from above, metres.
struct TownArea {
  double low_x, low_y, high_x, high_y;
};

/// Returns the objects whose bounds meet the area, by ascending id.
std::vector<TownInstance> place_town_objects(std::uint64_t seed, const TownTerrain& terrain,
                                             const TownModels& models, const TownArea& area);

}  // namespace pcl_bv::detail
