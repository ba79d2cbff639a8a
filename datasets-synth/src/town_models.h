// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Models of the objects of the town, sampled once. Every object of the town is a copy of one of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "street_model.h"

namespace pcl_bv::detail {

/// Sets of models from which the town takes its objects.
enum class TownModelSet : std::uint8_t {
  house,
  front,  // hedges and walls towards the road
  fence,
  low_wall,
  plant,  // trees and bushes
  park_tree,
  car,
  lamp_post,
  sign_post
};
inline constexpr std::size_t kTownModelSets = 9;

/// Points on a model that are visible from above or from one of the four sides, in the model's frame.
struct TownModel {
  SynthObjectKind kind = SynthObjectKind::house;
  std::vector<Vec3> points;
  Box3 bounds;           ///< Of the points.
  bool upright = false;  ///< Whether it stays upright on slopes. Cars, walls, hedges and fences tilt.
};

using TownModels = std::array<std::vector<TownModel>, kTownModelSets>;

/// Samples all models. The points are about `spacing` metres apart, nearer on thin models.
TownModels sample_town_models(std::uint64_t seed, double spacing);

}  // namespace pcl_bv::detail
