// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Geometric models of the objects, each in its own frame: x forward, y left, z up from the base.
#pragma once

#include <vector>

#include "pcl_bv/synth/random.h"
#include "pcl_bv/synth/street.h"
#include "vec3.h"

namespace pcl_bv::detail {

/// The half-space normal . p <= offset.
struct SolidHalfSpace {
  Vec3 normal;
  double offset;
};

/// A convex solid: the intersection of the half-spaces or, if there are none, the ellipsoid inscribed in
/// `bounds`.
struct Part {
  Box3 bounds;
  std::vector<SolidHalfSpace> half_spaces;
  std::vector<Box3> pockets;    ///< Boxes cut out of the solid: windows, wheel arches.
  double free_path = 0;         ///< Mean path length of a ray inside foliage, metres. 0: opaque.
  double loss_probability = 0;  ///< Probability that a hit gives no return (glass).
};

struct Model {
  SynthObjectKind kind;
  std::vector<Part> parts;
  Box3 bounds;
};

/// Each function generates one model with random dimensions.
Model make_car(SplitMix64& random);
Model make_pedestrian(SplitMix64& random);
Model make_lamp_post(SplitMix64& random);
Model make_sign_post(SplitMix64& random);
Model make_house(SplitMix64& random);
Model make_hedge_or_wall(SplitMix64& random);
Model make_tree(SplitMix64& random);
Model make_bush(SplitMix64& random);
Model make_cyclist(SplitMix64& random);
Model make_low_wall(SplitMix64& random);
Model make_avenue_tree(SplitMix64& random);
Model make_bridge(SplitMix64& random);

}  // namespace pcl_bv::detail
