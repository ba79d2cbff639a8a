// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "merged_cloud.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>
#include <limits>
#include <optional>
#include <vector>

#include "commands/pcd_bv/process.h"
#include "commands/pcd_bv/shares.h"
#include "commands/shared/messages.h"
#include "costs.h"
#include "failures.h"
#include "pcl_bv/fitting/fit.h"
#include "volume_bytes.h"

namespace pcl_bv {
using namespace detail;
namespace {

using Failure = std::optional<TileFailure>;

// Thrown to end the solver when a rank cannot read its points.
struct QueryFailed {};

// Whether the method is fitted by rounds of queries to all ranks.
bool needs_query_rounds(const Method& method, const Tiles& tiles) {
  return method.name == "sphere-exact" && tiles.xyz().count > Partial::kMaxStored;
}

/// One attempt to fit the volumes to the tiles that are not excluded. All ranks execute the same steps. A
/// step that may fail returns the same failure on all ranks.
class Attempt {
 public:
  Attempt(Ranks& ranks, const Tiles& tiles, const Options& options)
      : ranks_(ranks), tiles_(tiles), options_(options), execution_(execution_of(options)) {
    range_ = tiles.share(ranks.rank(), ranks.size());
    methods_ = options.pipeline.methods();
    fitted_.resize(methods_.size());
    outside_.resize(methods_.size());
  }

  Failure run();
  Report report() const;  ///< Must be called on the first rank only.
  std::size_t rounds() const { return rounds_; }
  /// CPU time of this rank without waiting for other ranks, seconds.
  double cpu_seconds() const { return cpu_seconds_; }

 private:
  /// Runs a part of a step that needs no other rank, and adds its CPU time to cpu_seconds().
  template <typename Work>
  Failure work(const Work& own) {
    const double begin = processor_seconds();
    Failure failure = run_and_catch(own);
    cpu_seconds_ += processor_seconds() - begin;
    return failure;
  }

  Failure find_origin();
  Failure read_own_points();
  void merge();
  Failure fit();
  Failure fit_in_rounds(Fitted<AnyVolume>& fitted);
  Failure check();
  bool run_query(const FarQuery& query, Failure& failure, OctantPoints& found);

  /// Returns the rank that fits the method to all points, or nothing if the method does not need all points.
  std::optional<std::size_t> owner(std::size_t method) const {
    if (!needs_all_points(*methods_[method], method_options(options_))) return std::nullopt;
    return method % ranks_.size();
  }

  Ranks& ranks_;
  const Tiles& tiles_;
  const Options& options_;
  const Execution execution_;
  PointRange range_;
  std::vector<const Method*> methods_;
  std::optional<Eigen::Vector3d> origin_;
  std::optional<SharePoints> points_;
  std::optional<FarthestFinder> farthest_;  // of points_
  // Before merge(), the partial result of this rank's points. After merge(), the first rank has the partial
  // result of all points. With --check, all ranks have it.
  PartialFile merged_;
  std::vector<Fitted<AnyVolume>> fitted_;
  std::vector<std::size_t> outside_;
  std::size_t rounds_ = 0;
  double cpu_seconds_ = 0;
};

// If the options request an origin but do not give it, the origin is the middle of the axis-aligned box of
// all points, rounded to whole numbers. The box is exact, so the origin does not depend on the number of
// ranks.
Failure Attempt::find_origin() {
  origin_ = options_.origin.at;
  if (!options_.origin.requested || origin_) return std::nullopt;
  Aabb box;
  const Failure failure = work([&] {
    const PointView all = tiles_.xyz();
    box = *fit_aabb(all.slice(range_.first, range_.second - range_.first), execution_);
  });
  constexpr double none = std::numeric_limits<double>::infinity();
  std::vector<double> bounds(6, none);
  for (int k = 0; k < 3 && !box.empty(); ++k) {
    bounds[static_cast<std::size_t>(k)] = box.min()[k];
    bounds[3 + static_cast<std::size_t>(k)] = -box.max()[k];
  }
  bounds = ranks_.min_over_ranks(bounds);
  const Eigen::Vector3d low(bounds[0], bounds[1], bounds[2]), high(-bounds[3], -bounds[4], -bounds[5]);
  origin_ =
      bounds[0] == none ? Eigen::Vector3d::Zero() : Eigen::Vector3d(Aabb(low, high).center().array().round());
  return first_failure(ranks_, failure);
}

Failure Attempt::read_own_points() {
  const Failure failure = work([&] {
    points_.emplace(tiles_, range_, origin_, options_);
    merged_ = describe_cloud(tiles_, origin_, options_);
    add_share(*points_, range_, execution_, merged_);
    std::optional<SharePoints> all;
    for (std::size_t i = 0; i < methods_.size(); ++i) {
      if (owner(i) != ranks_.rank()) continue;
      if (!all) all.emplace(tiles_, PointRange{0, tiles_.xyz().count}, origin_, options_);
      fitted_[i] = methods_[i]->fit(all->view(), method_options(options_), execution_);
    }
  });
  return first_failure(ranks_, failure);
}

// Merges the partial results along a binary tree of the ranks. MPI_Reduce is not used, because it needs
// messages of equal length.
void Attempt::merge() {
  for (std::size_t step = 1; step < ranks_.size(); step *= 2) {
    if (ranks_.rank() % (2 * step) == step) {
      ranks_.send(partial_file_content(merged_), ranks_.rank() - step);
      break;
    }
    if (ranks_.rank() + step >= ranks_.size()) continue;
    const std::string content = ranks_.receive(ranks_.rank() + step);
    work([&] { merged_.merge(parse_partial_file(content)); });
  }
  if (options_.check)
    merged_ = parse_partial_file(ranks_.broadcast(ranks_.first() ? partial_file_content(merged_) : ""));
}

Failure Attempt::fit() {
  for (std::size_t i = 0; i < methods_.size(); ++i) {
    Fitted<AnyVolume>& fitted = fitted_[i];
    if (const auto rank = owner(i)) {
      fitted = fitted_from(ranks_.broadcast(*rank == ranks_.rank() ? bytes_of(fitted) : "", *rank));
    } else if (needs_query_rounds(*methods_[i], tiles_)) {
      if (Failure failure = fit_in_rounds(fitted)) return failure;
    } else if (ranks_.first() || options_.check) {
      work([&] { fitted = merged_.partial.fit(*methods_[i], method_options(options_), execution_); });
    }
  }
  return std::nullopt;
}

// Returns whether all ranks have answered the query.
bool Attempt::run_query(const FarQuery& query, Failure& failure, OctantPoints& found) {
  OctantPoints own;
  const Failure now = run_and_catch([&] {
    if (!farthest_) farthest_.emplace(points_->view(), execution_);
    (*farthest_)(query, own);
  });
  if (now) failure = now;
  return !ranks_.merge_farthest(own, now.has_value(), found);
}

// The first rank runs the solver and broadcasts the bytes of the solver's queries. Each rank answers a query
// for its own points. An empty message ends the rounds.
Failure Attempt::fit_in_rounds(Fitted<AnyVolume>& fitted) {
  Failure failure;
  OctantPoints found;
  if (ranks_.first()) {
    const auto query_all_ranks = [&](const FarQuery& query, OctantPoints& farthest) {
      ranks_.broadcast(std::string(reinterpret_cast<const char*>(&query), sizeof query));
      if (!run_query(query, failure, farthest)) throw QueryFailed();
      return std::any_of(farthest.begin(), farthest.end(),
                         [](const FarPoint& p) { return p.squared_distance >= 0; });
    };
    try {
      const Certified<Sphere, SphereCertificate> sphere =
          fit_smallest_sphere(merged_.partial, query_all_ranks, execution_);
      static_cast<EstimationResult&>(fitted) = sphere;
      fitted.volume = sphere.volume;
      rounds_ += static_cast<std::size_t>(sphere.certificate.passes);
    } catch (const QueryFailed&) {
    }
    ranks_.broadcast("");
  } else {
    for (std::string bytes = ranks_.broadcast(""); !bytes.empty(); bytes = ranks_.broadcast("")) {
      FarQuery query;
      std::memcpy(&query, bytes.data(), sizeof query);
      run_query(query, failure, found);
    }
  }
  if (Failure first = first_failure(ranks_, failure)) return first;
  fitted = fitted_from(ranks_.broadcast(ranks_.first() ? bytes_of(fitted) : ""));
  return std::nullopt;
}

Failure Attempt::check() {
  const Failure failure = work([&] {
    for (std::size_t i = 0; i < methods_.size() && options_.check; ++i)
      outside_[i] = verify(fitted_[i].volume, points_->view(), execution_).outside;
    tiles_.require_unchanged();
  });
  outside_ = ranks_.sum(outside_);
  return first_failure(ranks_, failure);
}

Failure Attempt::run() {
  if (Failure failure = find_origin()) return failure;
  if (Failure failure = read_own_points()) return failure;
  merge();
  if (Failure failure = fit()) return failure;
  return check();
}

Report Attempt::report() const {
  Report report = report_of(merged_, methods_);
  for (std::size_t i = 0; i < methods_.size(); ++i) {
    set_volume(i, fitted_[i], fitted_[i].volume, report);
    VolumeEntry& entry = report.clusters.front().volumes[i];
    if (options_.check && entry.failed.empty()) entry.outside = outside_[i];
  }
  const std::string coarse =
      coarse_warning(aabb(fitted_.front().volume), origin_ ? ScalarType::float64 : tiles_.xyz().scalar);
  if (!coarse.empty()) report_problem(report.file + ": " + coarse);
  return report;
}

}  // namespace

Status detail::fit_merged(Ranks& ranks, Tiles& tiles, const Options& options, Report& report) {
  const auto begin = std::chrono::steady_clock::now();
  Status status = Status::done;
  if (ranks.first()) status = report_excluded_inputs(tiles);
  for (;;) {
    if (tiles.included_count() == 0) throw IoError("no input could be read");
    Attempt now(ranks, tiles, options);
    if (Failure failure = now.run()) {
      if (ranks.first()) report_problem(tiles.jobs()[failure->tile].input + ": " + failure->reason);
      tiles.exclude(failure->tile, failure->reason);
      status = Status::failed;
      continue;
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    if (options.timings)
      print_costs(ranks, {seconds.count(), now.cpu_seconds(), ranks.messages_sent(), ranks.bytes_sent(),
                          now.rounds()});
    if (!ranks.first()) return status;
    report_notes(tiles);
    report = now.report();
    set_left_out(tiles, report);
    if (options.timings) report.seconds = {0, 0, seconds.count()};
    return worse(status, report_failures(report));
  }
}

}  // namespace pcl_bv
