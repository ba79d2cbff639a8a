// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Bounding volumes of a sensor's last sweeps, updated sweep by sweep.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/fitting/partial.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A sliding window over a sensor's last sweeps, for bounding volumes of all points in the window.
///
/// The window stores a Partial for each sweep, not the points themselves. Adding a sweep costs one Partial of
/// the sweep and two merges on average, whatever the size of the window.
///
/// The volumes are bit by bit those of one Partial of all points in the window, with the indices that add()
/// gives to the points. They are also bit by bit those of a fit of all these points, except for the methods
/// that Partial names and the methods that begin with moments.
///
/// Not thread-safe, because the const function merged() changes the object.
class SweepWindow {
 public:
  /// Makes an empty window for the last `sweeps` sweeps. Throws std::invalid_argument for 0.
  explicit SweepWindow(std::size_t sweeps);

  /// Adds the newest sweep, and drops the oldest if the window is full.
  ///
  /// Points are numbered in the order of insertion: the first index of a sweep follows the last index of the
  /// previous sweep. The indices of the view are ignored. Throws as Partial does (for example for a view with
  /// an index list). Throws std::invalid_argument if the window has points of the other scalar type. If it
  /// throws, nothing is changed.
  void add(const PointView& points, const Execution& execution = {});

  /// Drops the oldest sweep, if there is one.
  void drop_oldest();

  std::size_t capacity() const { return capacity_; }                    ///< Largest number of sweeps.
  std::size_t size() const { return oldest_.size() + newest_.size(); }  ///< Number of sweeps.
  std::size_t point_count() const { return points_; }   ///< Number of points in the window, valid or not.
  std::uint64_t first_index() const { return first_; }  ///< Index of the first point in the window.

  /// Returns the Partial of all points in the window, which fit() takes for any method for which
  /// Partial::can_fit() holds. Without sweeps the Partial has no points. The first call after a change costs
  /// one merge. Later calls return the stored Partial. The reference is valid until the window changes.
  const Partial& merged() const;

 private:
  // The window is a queue of two stacks, because a sweep cannot be removed from a merged Partial. add()
  // pushes the sweep to newest_ and merges it into newest_merged_. drop_oldest() pops from oldest_, in which
  // each entry is merged with all newer entries. If oldest_ is empty, refill_oldest() moves all of newest_
  // there. So each sweep is merged twice.
  struct Sweep {
    Partial merged;  // an entry of oldest_ is merged with all newer entries
    std::size_t points;
  };

  void refill_oldest();

  std::size_t capacity_;
  std::vector<Sweep> oldest_;  // the last entry is the oldest sweep
  std::vector<Sweep> newest_;  // the last entry is the newest sweep
  Partial newest_merged_;
  std::uint64_t first_ = 0;
  std::size_t points_ = 0;
  ScalarType scalar_ = ScalarType::float32;  // scalar type of all points in the window
  mutable std::optional<Partial> merged_;
};

}  // namespace pcl_bv
