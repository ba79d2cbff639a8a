// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The table of all fitting methods, with names, aliases, shapes and fit functions. The commands, the file
// formats and the method name `all` use this table.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/fit_obb.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Options of the methods. A method ignores options that it does not use.
struct MethodOptions {
  SphereGrowth growth = SphereGrowth::deferred;   ///< Used by all spheres but sphere-exact.
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< ObbOptions::up, used by obb-yaw and obb-lshape.
};

/// A fitting method: its names, its fit function and what it needs.
struct Method {
  std::string_view name;                  ///< The canonical name, as written into results, e.g. "dop26".
  std::vector<std::string_view> aliases;  ///< Other accepted names.
  std::string_view shape;  ///< As shape_name() returns it; empty for `best`, whose shape varies.
  /// The function that fit() calls.
  EstimationResult (*fit_with)(const PointView&, const MethodOptions&, AnyVolume&, const Execution&);
  /// The directions whose supports the method finds first; empty if it begins with another pass.
  std::optional<DirectionSet> initial_directions;
  bool upright = false;           ///< Whether the boxes are upright and MethodOptions::up is used.
  bool needs_hull = false;        ///< Whether the method needs the convex hull.
  bool needs_all_points = false;  ///< Whether points deep inside the cloud can change the volume.

  /// Fits the volume to the points. The result is that of the method's function in fit.h or fit_obb.h.
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
/// supports first (Method::initial_directions), and not only along the coordinate axes, these supports are
/// found once. If two or more methods need the convex hull, it is computed once, with the supports along
/// dop26. The results are stored in `supports`, which must outlive the returned execution. If neither case
/// applies, the execution is returned unchanged.
Execution share_supports(const PointView& points, const std::vector<const Method*>& among,
                         const Execution& execution, Supports& supports);

/// Returns the methods that the name `all` stands for: every method except `hull`, whose size is not bounded,
/// and `best`, whose volume is that of another method.
const std::vector<const Method*>& methods_of_all();

/// Fits each of the methods and returns the smallest of the volumes. Equal volumes (of flat points) are
/// compared by surface area, then by the order of the methods. Methods that fail are skipped. If all fail,
/// the result is that of the first method. `winner`, if not null, is set to the method of the returned
/// volume, or to null if there is no valid point or all methods fail. Throws std::invalid_argument if `among`
/// is empty.
EstimationResult fit_smallest(const PointView& points, const std::vector<const Method*>& among,
                              AnyVolume& volume, const Execution& execution = {},
                              const MethodOptions& options = {}, const Method** winner = nullptr);

/// Returns the methods from which `best` chooses: those of aabb, obb-dito14, obb-min, sphere-exact, cylinder
/// and capsule that this build has.
const std::vector<const Method*>& best_candidates();

/// Returns the growth named "sequential", "stationary" or "deferred". Throws std::invalid_argument, listing
/// these names, for any other text.
SphereGrowth parse_growth(std::string_view name);

}  // namespace pcl_bv
