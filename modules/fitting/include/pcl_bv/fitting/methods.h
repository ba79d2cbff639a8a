// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The table of all fitting methods: names, aliases, shapes and fits. The commands, the file formats and `all`
// are based on it.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/fit_obb.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Options besides the method itself. Methods ignore options that do not concern them.
struct MethodOptions {
  SphereGrowth growth = SphereGrowth::deferred;   ///< For spheres that grow: all but sphere-exact.
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< For obb-yaw and obb-lshape: ObbOptions::up.
};

/// A fitting method: its names, its fit function and what it needs.
struct Method {
  std::string_view name;                  ///< The canonical name, as written into results: "dop26".
  std::vector<std::string_view> aliases;  ///< Other accepted names.
  std::string_view shape;  ///< As shape_name() returns it; empty for `best`, whose shape varies.
  /// Called by fit().
  EstimationResult (*fit_with)(const PointView&, const MethodOptions&, AnyVolume&, const Execution&);
  /// The directions whose supports it finds first; empty if it begins with another pass.
  std::optional<DirectionSet> initial_directions;
  bool upright = false;           ///< Whether its boxes are upright: it uses MethodOptions::up.
  bool needs_hull = false;        ///< Whether it needs the convex hull.
  bool needs_all_points = false;  ///< Whether points deep inside the cloud can change the volume.

  /// Fits the method to the points; the result is as for the function in fit.h or fit_obb.h.
  EstimationResult fit(const PointView& points, AnyVolume& volume, const Execution& execution,
                       const MethodOptions& options = {}) const {
    return fit_with(points, options, volume, execution);
  }
};

/// Returns all methods of this build, in the order of the documentation.
const std::vector<Method>& methods();

/// Returns the method with this name or alias; null if there is none.
const Method* find_method(std::string_view name);

/// Prepares an execution for fitting several methods to the same points. If two or more of the methods find
/// supports first (initial_directions), and not only along the coordinate axes, these are found once. If two
/// or more need the convex hull, it is computed once, with the supports along dop26. The results are stored
/// in `supports`, which must outlive the returned execution. If neither applies, the execution is returned
/// unchanged.
Execution share_supports(const PointView& points, const std::vector<const Method*>& among,
                         const Execution& execution, Supports& supports);

/// Returns the methods that `all` stands for: every method except `hull`, whose size is not bounded, and
/// `best`, which is one of the others.
const std::vector<const Method*>& methods_of_all();

/// Fits each of the methods and returns the smallest of the volumes. Equal volumes (of flat points) are
/// ordered by surface area, then by the order of the methods. Methods that fail are skipped; if all fail, the
/// result is that of the first. `winner`, if not null, is set to the method of the returned volume; to null
/// if there is no valid point or all methods fail. Throws std::invalid_argument if `among` is empty.
EstimationResult fit_smallest(const PointView& points, const std::vector<const Method*>& among,
                              AnyVolume& volume, const Execution& execution = {},
                              const MethodOptions& options = {}, const Method** winner = nullptr);

/// Returns the methods that `best` chooses from: aabb, obb-dito14, obb-min, sphere-exact, cylinder and
/// capsule, as far as this build has them.
const std::vector<const Method*>& best_candidates();

/// Returns the growth named "sequential", "stationary" or "deferred". Throws std::invalid_argument, listing
/// these names, for any other text.
SphereGrowth parse_growth(std::string_view name);

}  // namespace pcl_bv
