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
/// It stores a Partial for each sweep, not the points themselves. Adding a sweep costs a Partial of it and
/// two merges on average, whatever the size of the window.
///
/// The volumes are bit by bit those of one Partial of all points in the window, with the indices that add()
/// gives them. They are also bit by bit those of a fit of all these points, except for the methods that
/// Partial names and the methods that begin with moments.
///
/// Not thread-safe: merged() also changes the object.
class SweepWindow {
 public:
  /// An empty window for the last `sweeps` sweeps. Throws std::invalid_argument for 0.
  explicit SweepWindow(std::size_t sweeps);

  /// Adds the newest sweep, and drops the oldest if the window is full.
  ///
  /// Points are numbered as they arrive: the indices continue those of the sweep before, and the indices of
  /// the view are ignored. Throws as Partial does (for example for a view with an index list), and
  /// std::invalid_argument if the window has points of the other scalar type. Then nothing is changed.
  void add(const PointView& points, const Execution& execution = {});

  /// Drops the oldest sweep. Without sweeps it does nothing.
  void drop_oldest();

  std::size_t capacity() const { return capacity_; }                    ///< Largest number of sweeps.
  std::size_t size() const { return oldest_.size() + newest_.size(); }  ///< Number of sweeps.
  std::size_t point_count() const { return points_; }   ///< Number of points of these sweeps, valid or not.
  std::uint64_t first_index() const { return first_; }  ///< Index of the first point in the window.

  /// Returns the Partial of all points in the window: fit() takes any method for which Partial::can_fit()
  /// holds. It has no points if there is no sweep. The first call after a change costs one merge, later calls
  /// nothing. The reference is valid until the window changes.
  const Partial& merged() const;

 private:
  // A queue of two stacks, as a sweep cannot be taken out of a merged Partial. add() pushes to newest_ and
  // merges into newest_merged_. drop_oldest() pops from oldest_, in which each entry is merged with all that
  // are newer. If oldest_ is empty, refill_oldest() moves all of newest_ there. So each sweep is merged
  // twice.
  struct Sweep {
    Partial merged;  // in oldest_: merged with all newer sweeps in oldest_
    std::size_t points;
  };

  void refill_oldest();

  std::size_t capacity_;
  std::vector<Sweep> oldest_;  // the last entry is the oldest sweep
  std::vector<Sweep> newest_;  // the last entry is the newest sweep
  Partial newest_merged_;
  std::uint64_t first_ = 0;
  std::size_t points_ = 0;
  ScalarType scalar_ = ScalarType::float32;  // of all points in the window
  mutable std::optional<Partial> merged_;
};

}  // namespace pcl_bv
