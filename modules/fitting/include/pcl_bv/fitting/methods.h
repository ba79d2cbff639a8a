// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The one table of methods: names, aliases, shapes and fits. Commands, files and `all` read it.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/fit_obb.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What a method's user may choose besides it. Methods ignore what does not concern them.
struct MethodOptions {
  SphereGrowth growth = SphereGrowth::deferred;   ///< Spheres that grow: all but sphere-exact.
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Upright boxes: obb-yaw and obb-lshape.
};

struct Method {
  std::string_view name;                  ///< The canonical name, as written into results: "dop26".
  std::vector<std::string_view> aliases;  ///< Other names that mean it.
  std::string_view shape;  ///< As shape_name() says; empty for `best`, which depends on the points.
  EstimationResult (*fit_with)(const PointView&, const MethodOptions&, AnyVolume&, const Execution&);
  std::optional<DirectionSet> begins_with;  ///< The supports that it looks for first, if it does.
  bool upright = false;                     ///< Whether it asks for MethodOptions::up.
  bool on_hull = false;                     ///< Whether it needs the convex hull.
  bool needs_all_points = false;            ///< Whether points deep inside can change the volume.

  EstimationResult fit(const PointView& points, AnyVolume& volume, const Execution& execution,
                       const MethodOptions& options = {}) const {
    return fit_with(points, options, volume, execution);
  }
};

/// All methods of this build, in the order of the documentation.
const std::vector<Method>& methods();

/// The method with this name or alias, or null.
const Method* find_method(std::string_view name);

/// For fitting several methods to the same points: if two or more begin with supports, and not only with
/// those along the axes, finds them once, in `supports`, which must outlive the execution that is returned.
/// So with the convex hull, if two or more need it.
Execution share_supports(const PointView& points, const std::vector<const Method*>& among,
                         const Execution& execution, Supports& supports);

/// What `all` stands for: every method but the hull, which has no bound on its size, and `best`, which is one
/// of the others.
const std::vector<const Method*>& methods_of_all();

/// Fits each of the methods (at least one, or std::invalid_argument) and keeps the volume that is smallest,
/// of equally small (flat) ones that with the smallest surface, of equal ones the first. Those that fail are
/// left out; if all do, the result is that of the first. `winner`, if not null, becomes the volume's method;
/// null without a valid point and if all fail.
EstimationResult fit_smallest(const PointView& points, const std::vector<const Method*>& among,
                              AnyVolume& volume, const Execution& execution = {},
                              const MethodOptions& options = {}, const Method** winner = nullptr);

/// What `best` chooses from: the boxes, the smallest sphere, cylinder and capsule, as far as this build has
/// them.
const std::vector<const Method*>& best_candidates();

/// "sequential", "stationary" or "deferred". Throws std::invalid_argument, naming these, for any other text.
SphereGrowth parse_growth(std::string_view name);

}  // namespace pcl_bv
