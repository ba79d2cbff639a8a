// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Volumes around all points of a sensor's last sweeps, without starting over with each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/fitting/partial.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// The last sweeps of a sensor, each as a Partial: what it adds to volumes around all of them. Points
/// themselves are not kept, but for what a Partial keeps.
///
/// A sweep that leaves cannot be taken out of a merged Partial. So there are two stacks: one that sweeps come
/// to, of which all are merged, and one that they leave from, where each is merged with all that came after
/// it. When the latter is empty, the former is turned over into it. So a sweep is merged twice in its life,
/// and once more where all() is asked for, whatever the size of the window.
///
/// Volumes are as Partial says for these points by these numbers: the bits of a Partial of them all, and but
/// for the methods named there, and those that begin with moments, of a fit of them all.
///
/// Not to be used by several threads at a time.
class SweepWindow {
 public:
  /// Of the last `sweeps` (at least 1, or std::invalid_argument).
  explicit SweepWindow(std::size_t sweeps);

  /// The newest sweep; the oldest leaves if there are more than the window holds. Points are numbered as they
  /// come: this sweep's follow the last one's, whatever they are called in their view. Costs a Partial of the
  /// sweep and, on average, two merges. Throws what Partial does, for a view with an index list among others,
  /// and std::invalid_argument for floats among doubles and the other way round; then nothing is changed.
  void add(const PointView& points, const Execution& execution = {});

  /// The oldest sweep leaves, if there is one.
  void drop_oldest();

  std::size_t capacity() const { return capacity_; }                    ///< Sweeps that the window holds.
  std::size_t size() const { return oldest_.size() + newest_.size(); }  ///< Sweeps in it.
  std::size_t points() const { return points_; }  ///< Of the sweeps in it, valid or not.
  std::uint64_t first() const { return first_; }  ///< Number of the first point in it.

  /// What all points in the window contribute: with fit() for any method that Partial::serves(). Of no points
  /// if there is no sweep. Merged when asked for first after a change: one merge.
  const Partial& all() const;

 private:
  struct Sweep {
    Partial merged;  // in oldest_: with all that came after it to there
    std::size_t points;
  };

  void turn_over();

  std::size_t capacity_;
  std::vector<Sweep> oldest_;  // the next to leave is the last
  std::vector<Sweep> newest_;  // the last is the newest
  Partial newest_merged_;
  std::uint64_t first_ = 0;
  std::size_t points_ = 0;
  ScalarType scalar_ = ScalarType::float32;  // of those, if there are any
  mutable std::optional<Partial> all_;
};

}  // namespace pcl_bv
