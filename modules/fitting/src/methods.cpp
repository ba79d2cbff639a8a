// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/methods.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "hull/local_hull.h"
#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/numeric/float_environment.h"

namespace pcl_bv {
using namespace detail;
namespace {

template <typename Volume, EstimationResult (*fit)(const PointView&, Volume&, const FitExecution&)>
EstimationResult plain(const PointView& points, const MethodOptions&, AnyVolume& volume,
                       const FitExecution& execution) {
  return fit(points, volume.emplace<Volume>(), execution);
}

template <const std::shared_ptr<const KdopSet>& (*set)()>
EstimationResult kdop(const PointView& points, const MethodOptions&, AnyVolume& volume,
                      const FitExecution& execution) {
  return detail::fit_kdop(points, set(), volume.emplace<Kdop>(set()), nullptr, execution);
}

template <SphereMethod method>
EstimationResult sphere(const PointView& points, const MethodOptions& options, AnyVolume& volume,
                        const FitExecution& execution) {
  return detail::fit_sphere(points, {method, options.growth}, volume.emplace<Sphere>(), execution);
}

template <ObbMethod method>
EstimationResult obb(const PointView& points, const MethodOptions& options, AnyVolume& volume,
                     const FitExecution& execution) {
  return detail::fit_obb(points, {method, options.up}, volume.emplace<Obb>(), execution);
}

EstimationResult prism(const PointView& points, const MethodOptions& options, AnyVolume& volume,
                       const FitExecution& execution) {
  return detail::fit_prism(points, {options.up, options.concave_length}, volume.emplace<Prism>(), execution);
}

EstimationResult ellipsoid(const PointView& points, const MethodOptions&, AnyVolume& volume,
                           const FitExecution& execution) {
  EllipsoidCertificate certificate;
  return detail::fit_ellipsoid(points, volume.emplace<Ellipsoid>(), certificate, execution);
}

EstimationResult best(const PointView& points, const MethodOptions& options, AnyVolume& volume,
                      const FitExecution& execution) {
  const Method* winner = nullptr;
  return detail::fit_smallest(points, best_candidates(), options, volume, winner, execution);
}

// Returns the smallest set that contains the directions of `a` and `b`.
DirectionSet union_of(DirectionSet a, DirectionSet b) {
  if (a == b || b == DirectionSet::dop6) return a;
  return a == DirectionSet::dop6 ? b : DirectionSet::dop26;
}

struct Row {
  Method method;
  MethodFit implementation;
};

const std::vector<Row>& rows() {
  using Set = DirectionSet;
  constexpr bool upright = true, all_points = true, hull = true, box = true;
  static const std::vector<Row> table = {
      {{"aabb", {}, "aabb"}, {plain<Aabb, detail::fit_aabb>, Set::dop6, !hull, box}},
      {{"dop6", {}, "kdop"}, {kdop<KdopSet::dop6>, Set::dop6, !hull, box}},
      {{"dop14", {}, "kdop"}, {kdop<KdopSet::dop14>, Set::dop14}},
      {{"dop18", {}, "kdop"}, {kdop<KdopSet::dop18>, Set::dop18}},
      {{"dop26", {}, "kdop"}, {kdop<KdopSet::dop26>, Set::dop26}},
      {{"sphere-ritter", {}, "sphere", !upright, all_points}, {sphere<SphereMethod::ritter>, Set::dop6}},
      {{"sphere-epos6", {}, "sphere", !upright, all_points}, {sphere<SphereMethod::epos6>, Set::dop6}},
      {{"sphere-epos14", {}, "sphere", !upright, all_points}, {sphere<SphereMethod::epos14>, Set::dop14}},
      {{"sphere-epos26", {}, "sphere", !upright, all_points}, {sphere<SphereMethod::epos26>, Set::dop26}},
      {{"sphere-epos98", {}, "sphere", !upright, all_points}, {sphere<SphereMethod::epos98>, Set::dop26}},
      {{"sphere-exact", {"sphere"}, "sphere"}, {sphere<SphereMethod::exact>, Set::dop26}},
      {{"obb-pca", {}, "obb"}, {obb<ObbMethod::pca>, {}, !hull, box}},
      {{"obb-dito14", {}, "obb"}, {obb<ObbMethod::dito14>, Set::dop14}},
      {{"obb-min", {"obb"}, "obb"}, {obb<ObbMethod::minimal>, {}, hull}},
      {{"obb-yaw", {}, "obb", upright}, {obb<ObbMethod::yaw>, Set::dop26}},
      {{"obb-lshape", {}, "obb", upright, all_points}, {obb<ObbMethod::lshape>, Set::dop26}},
      {{"prism", {}, "prism", upright}, {prism, Set::dop26}},
      {{"cylinder", {}, "cylinder"}, {plain<Cylinder, detail::fit_cylinder>, Set::dop26, hull}},
      {{"capsule", {}, "capsule"}, {plain<Capsule, detail::fit_capsule>, Set::dop26, hull}},
      {{"ellipsoid", {}, "ellipsoid"}, {ellipsoid, Set::dop26, hull}},
      {{"hull", {}, "hull"}, {plain<Hull, detail::fit_hull>, Set::dop26, hull}},
      {{"best", {}, ""}, {best, Set::dop26, hull}},
  };
  return table;
}

}  // namespace

const std::vector<Method>& methods() {
  static const std::vector<Method> table = [] {
    std::vector<Method> all;
    for (const Row& row : rows()) {
      all.push_back(row.method);
      all.back().implementation = &row.implementation;
    }
    return all;
  }();
  return table;
}

Fitted<AnyVolume> Method::fit(const PointView& points, const MethodOptions& options,
                              const Execution& execution) const {
  return make_fitted<Fitted<AnyVolume>>(
      [&](auto& made) { return fit_method(*this, points, options, made.volume, execution); });
}

std::vector<Fitted<AnyVolume>> fit_methods(const PointView& points, const std::vector<const Method*>& among,
                                           const MethodOptions& options, const Execution& execution) {
  const FloatEnvironment environment;
  Supports supports;
  const FitExecution shared = detail::share_supports(points, among, execution, supports);
  std::vector<Fitted<AnyVolume>> all;
  all.reserve(among.size());
  for (const Method* method : among) {
    all.push_back(make_fitted<Fitted<AnyVolume>>(
        [&](auto& made) { return fit_method(*method, points, options, made.volume, shared); }));
  }
  return all;
}

bool needs_all_points(const Method& method, const MethodOptions& options) {
  return method.needs_all_points ||
         (method.shape == "prism" && options.concave_length < std::numeric_limits<double>::infinity());
}

const Method* find_method(std::string_view name) {
  for (const Method& method : methods()) {
    const auto& aliases = method.aliases;
    if (method.name == name || std::find(aliases.begin(), aliases.end(), name) != aliases.end())
      return &method;
  }
  return nullptr;
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

FittedSmallest fit_smallest(const PointView& points, const std::vector<const Method*>& among,
                            const MethodOptions& options, const Execution& execution) {
  return make_fitted<FittedSmallest>([&](auto& made) {
    return detail::fit_smallest(points, among, options, made.volume, made.method, execution);
  });
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

namespace detail {

EstimationResult fit_method(const Method& method, const PointView& points, const MethodOptions& options,
                            AnyVolume& volume, const FitExecution& execution) {
  return method.implementation->fit(points, options, volume, execution);
}

std::optional<DirectionSet> directions_of(const std::vector<const Method*>& among) {
  std::optional<DirectionSet> widest;
  for (const Method* method : among) {
    const std::optional<DirectionSet>& directions = method->implementation->directions;
    if (directions) widest = !widest ? *directions : union_of(*widest, *directions);
  }
  return widest;
}

FitExecution share_supports(const PointView& points, const std::vector<const Method*>& among,
                            const FitExecution& execution, Supports& supports) {
  std::size_t with_supports = 0, with_hull = 0, with_box = 0;
  for (const Method* method : among) {
    with_hull += method->implementation->needs_hull ? 1 : 0;
    with_supports += method->implementation->directions ? 1 : 0;
    with_box += method->implementation->needs_box ? 1 : 0;
  }
  const std::optional<DirectionSet> widest = directions_of(among);
  const bool hull = with_hull > 1;
  const bool wide = hull || (with_supports > 1 && *widest != DirectionSet::dop6);
  if (!wide && (with_box < 2 || execution.supports != nullptr)) return execution;
  supports =
      wide ? find_supports(points, hull ? DirectionSet::dop26 : *widest, SupportDetail::points, execution)
           : find_supports(points, DirectionSet::dop6, SupportDetail::bounds, execution);
  if (hull && supports.used > 0)
    supports.hull = shared_hull(points, supports, LocalFrame(supports), execution);
  FitExecution shared = execution;
  shared.supports = &supports;
  return shared;
}

EstimationResult fit_smallest(const PointView& points, const std::vector<const Method*>& among,
                              const MethodOptions& options, AnyVolume& volume, const Method*& winner,
                              const FitExecution& execution) {
  if (among.empty()) throw std::invalid_argument("fit_smallest: among must name at least one method");
  EstimationResult result;
  const Method* found = nullptr;
  Supports supports;
  const FitExecution shared = share_supports(points, among, execution, supports);
  const auto failed = [](const EstimationResult& r) { return r.status == EstimationStatus::failed; };
  const auto size = [](const AnyVolume& v) { return std::pair(pcl_bv::volume(v), surface_area(v)); };
  for (const Method* method : among) {
    AnyVolume candidate;
    const EstimationResult fitted = fit_method(*method, points, options, candidate, shared);
    const bool better =
        found == nullptr || (!failed(fitted) && (failed(result) || size(candidate) < size(volume)));
    if (!better) continue;
    volume = std::move(candidate);
    result = fitted;
    found = method;
  }
  winner = result.used > 0 && !failed(result) ? found : nullptr;
  return result;
}

}  // namespace detail
}  // namespace pcl_bv
