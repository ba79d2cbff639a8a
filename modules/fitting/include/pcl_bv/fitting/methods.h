// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The table of all fitting methods, with names, aliases, shapes and fit functions. The commands, the file
// formats and the method name `all` use this table.
#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Options of the methods. A method ignores options that it does not use.
struct MethodOptions {
  SphereGrowth growth = SphereGrowth::deferred;   ///< Used by all spheres but sphere-exact.
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Used by obb-yaw, obb-lshape and prism.
  /// Used by prism: PrismOptions::concave_length. Infinity: convex.
  double concave_length = std::numeric_limits<double>::infinity();
};

namespace detail {
struct MethodFit;
}

/// A fitting method: its names and what it needs.
struct Method {
  std::string_view name;                  ///< The canonical name, as written into results, e.g. "dop26".
  std::vector<std::string_view> aliases;  ///< Other accepted names.
  std::string_view shape;  ///< The result of shape_name(); empty for `best`, whose shape varies.
  bool upright = false;    ///< Whether the volumes are upright and MethodOptions::up is used.
  /// Whether points deep inside the cloud can change the volume, with default options.
  bool needs_all_points = false;
  const detail::MethodFit* implementation = nullptr;  ///< Not null for the methods of methods().

  /// Fits the volume to the points. The result is that of the method's function in fit.h.
  Fitted<AnyVolume> fit(const PointView& points, const MethodOptions& options = {},
                        const Execution& execution = {}) const;
};

/// Returns true for methods with Method::needs_all_points and for prisms with a concave outline.
bool needs_all_points(const Method& method, const MethodOptions& options);

/// Returns all methods of this build, in the order of the documentation.
const std::vector<Method>& methods();

/// Returns the method with this name or alias; null if there is none.
const Method* find_method(std::string_view name);

/// Fits several methods to the same points. Returns the fits in the order of `among`. A pass over the points
/// that several methods need is made only once. The volumes have the same bits as those of Method::fit().
std::vector<Fitted<AnyVolume>> fit_methods(const PointView& points, const std::vector<const Method*>& among,
                                           const MethodOptions& options = {},
                                           const Execution& execution = {});

/// Returns the methods that the name `all` stands for: every method except `hull`, whose size is not bounded,
/// and `best`, whose volume is that of another method.
const std::vector<const Method*>& methods_of_all();

/// The smallest of several volumes.
struct FittedSmallest : Fitted<AnyVolume> {
  const Method* method = nullptr;  ///< The method of the volume; null without a valid point or if all fail.
};

/// Fits each of the methods and returns the smallest of the volumes. Shapes of equal volume, such as those of
/// flat points, are compared by surface area, then by the order of the methods. Methods that fail are
/// skipped. If all fail, the result is that of the first method. Throws std::invalid_argument if `among` is
/// empty.
FittedSmallest fit_smallest(const PointView& points, const std::vector<const Method*>& among,
                            const MethodOptions& options = {}, const Execution& execution = {});

/// Returns the methods from which `best` chooses: aabb, obb-dito14, obb-min, sphere-exact, cylinder and
/// capsule.
const std::vector<const Method*>& best_candidates();

/// Returns the growth named "sequential", "stationary" or "deferred". Throws std::invalid_argument, listing
/// these names, for any other text.
SphereGrowth parse_growth(std::string_view name);

}  // namespace pcl_bv
