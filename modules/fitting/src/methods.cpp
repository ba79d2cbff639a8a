// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/methods.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "hull/local_hull.h"
#include "pcl_bv/numeric/float_environment.h"

namespace pcl_bv {
namespace {

template <typename Volume, EstimationResult (*fit)(const PointView&, Volume&, const Execution&)>
EstimationResult plain(const PointView& points, const MethodOptions&, AnyVolume& volume,
                       const Execution& execution) {
  return fit(points, volume.emplace<Volume>(), execution);
}

template <const std::shared_ptr<const KdopSet>& (*set)()>
EstimationResult kdop(const PointView& points, const MethodOptions&, AnyVolume& volume,
                      const Execution& execution) {
  return fit_kdop(points, set(), volume.emplace<Kdop>(set()), execution);
}

template <SphereMethod method>
EstimationResult sphere(const PointView& points, const MethodOptions& options, AnyVolume& volume,
                        const Execution& execution) {
  return fit_sphere(points, {method, options.growth}, volume.emplace<Sphere>(), execution);
}

template <ObbMethod method>
EstimationResult obb(const PointView& points, const MethodOptions& options, AnyVolume& volume,
                     const Execution& execution) {
  return fit_obb(points, {method, options.up}, volume.emplace<Obb>(), execution);
}

EstimationResult best(const PointView& points, const MethodOptions& options, AnyVolume& volume,
                      const Execution& execution) {
  return fit_smallest(points, best_candidates(), volume, execution, options);
}

// Returns the smallest set that contains the directions of `a` and `b`.
DirectionSet union_of(DirectionSet a, DirectionSet b) {
  if (a == b || b == DirectionSet::dop6) return a;
  return a == DirectionSet::dop6 ? b : DirectionSet::dop26;
}

}  // namespace

const std::vector<Method>& methods() {
  static const std::vector<Method> table = {
      {"aabb", {}, "aabb", plain<Aabb, fit_aabb>, DirectionSet::dop6},
      {"dop6", {}, "kdop", kdop<KdopSet::dop6>, DirectionSet::dop6},
      {"dop14", {}, "kdop", kdop<KdopSet::dop14>, DirectionSet::dop14},
      {"dop18", {}, "kdop", kdop<KdopSet::dop18>, DirectionSet::dop18},
      {"dop26", {}, "kdop", kdop<KdopSet::dop26>, DirectionSet::dop26},
      {"sphere-ritter", {}, "sphere", sphere<SphereMethod::ritter>, DirectionSet::dop6, false, false, true},
      {"sphere-epos6", {}, "sphere", sphere<SphereMethod::epos6>, DirectionSet::dop6, false, false, true},
      {"sphere-epos14", {}, "sphere", sphere<SphereMethod::epos14>, DirectionSet::dop14, false, false, true},
      {"sphere-epos26", {}, "sphere", sphere<SphereMethod::epos26>, DirectionSet::dop26, false, false, true},
      {"sphere-epos98", {}, "sphere", sphere<SphereMethod::epos98>, DirectionSet::dop26, false, false, true},
      {"sphere-exact", {"sphere"}, "sphere", sphere<SphereMethod::exact>, DirectionSet::dop26},
      {"obb-pca", {}, "obb", obb<ObbMethod::pca>, {}},
      {"obb-dito14", {}, "obb", obb<ObbMethod::dito14>, DirectionSet::dop14},
      {"obb-min", {"obb"}, "obb", obb<ObbMethod::minimal>, {}, false, true},
      {"obb-yaw", {}, "obb", obb<ObbMethod::yaw>, DirectionSet::dop26, true},
      {"obb-lshape", {}, "obb", obb<ObbMethod::lshape>, DirectionSet::dop26, true, false, true},
      {"cylinder", {}, "cylinder", plain<Cylinder, fit_cylinder>, DirectionSet::dop26, false, true},
      {"capsule", {}, "capsule", plain<Capsule, fit_capsule>, DirectionSet::dop26, false, true},
      {"ellipsoid", {}, "ellipsoid", plain<Ellipsoid, fit_ellipsoid>, DirectionSet::dop26, false, true},
      {"hull", {}, "hull", plain<Hull, fit_hull>, DirectionSet::dop26, false, true},
      {"best", {}, "", best, DirectionSet::dop26, false, true},
  };
  return table;
}

const Method* find_method(std::string_view name) {
  for (const Method& method : methods()) {
    const auto& aliases = method.aliases;
    if (method.name == name || std::find(aliases.begin(), aliases.end(), name) != aliases.end())
      return &method;
  }
  return nullptr;
}

Execution share_supports(const PointView& points, const std::vector<const Method*>& among,
                         const Execution& execution, Supports& supports) {
  const FloatEnvironment environment;
  std::size_t with_supports = 0, with_hull = 0;
  std::optional<DirectionSet> widest;
  for (const Method* method : among) {
    with_hull += method->needs_hull ? 1 : 0;
    if (!method->initial_directions) continue;
    ++with_supports;
    widest = !widest ? *method->initial_directions : union_of(*widest, *method->initial_directions);
  }
  const bool hull = with_hull > 1;
  Execution shared = execution;
  if (!hull && (with_supports < 2 || *widest == DirectionSet::dop6)) return shared;
  supports = find_supports(points, hull ? DirectionSet::dop26 : *widest, SupportDetail::points, execution);
  if (hull && supports.used > 0)
    supports.hull = shared_hull(points, supports, LocalFrame(supports), execution);
  shared.supports = &supports;
  return shared;
}

const std::vector<const Method*>& methods_of_all() {
  static const std::vector<const Method*> chosen = [] {
    std::vector<const Method*> found;
    for (const Method& method : methods()) {
      if (method.shape != "hull" && method.name != "best") found.push_back(&method);
    }
    return found;
  }();
  return chosen;
}

EstimationResult fit_smallest(const PointView& points, const std::vector<const Method*>& among,
                              AnyVolume& volume, const Execution& execution, const MethodOptions& options,
                              const Method** winner) {
  const FloatEnvironment environment;
  if (among.empty()) throw std::invalid_argument("fit_smallest: among must name at least one method");
  EstimationResult result;
  const Method* found = nullptr;
  Supports supports;
  const Execution shared = share_supports(points, among, execution, supports);
  const auto failed = [](const EstimationResult& r) { return r.status == EstimationStatus::failed; };
  const auto size = [](const AnyVolume& v) { return std::pair(pcl_bv::volume(v), surface_area(v)); };
  for (const Method* method : among) {
    AnyVolume candidate;
    const EstimationResult fitted = method->fit(points, candidate, shared, options);
    const bool better =
        found == nullptr || (!failed(fitted) && (failed(result) || size(candidate) < size(volume)));
    if (!better) continue;
    volume = std::move(candidate);
    result = fitted;
    found = method;
  }
  if (winner != nullptr) *winner = result.used > 0 && !failed(result) ? found : nullptr;
  return result;
}

const std::vector<const Method*>& best_candidates() {
  static const std::vector<const Method*> candidates = [] {
    std::vector<const Method*> found;
    for (const std::string_view name :
         {"aabb", "obb-dito14", "obb-min", "sphere-exact", "cylinder", "capsule"}) {
      if (const Method* method = find_method(name)) found.push_back(method);
    }
    return found;
  }();
  return candidates;
}

SphereGrowth parse_growth(std::string_view name) {
  if (name == "sequential") return SphereGrowth::sequential;
  if (name == "stationary") return SphereGrowth::stationary;
  if (name == "deferred") return SphereGrowth::deferred;
  throw std::invalid_argument("unknown growth '" + std::string(name) +
                              "'; known are sequential, stationary, deferred");
}

}  // namespace pcl_bv
