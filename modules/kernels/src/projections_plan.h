// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What the vectors of projections.cpp are told before their pass, and what follows from it.
#pragma once

#include <array>
#include <cstddef>

#include "extremes_plan.h"
#include "pcl_bv/kernels/extreme_point.h"
#include "pcl_bv/kernels/projections.h"

namespace pcl_bv {

/// A valid point amid the others, to which projections are relative: then zero is reached at every end, and
/// rounding errors are those of the extent, not of the place (UTM). Of at most 16 points the nearest to their
/// mean. False if there is no valid point.
bool central_point(const PointView& points, Coordinates& center);

/// What the pass over some points saw.
struct Relief {
  Coordinates center{};
  std::array<double, 3> spread{};  ///< Greatest magnitudes of p - center, as rounded.
};

/// What follows for the two ends of a direction.
class ProjectionPlan {
 public:
  ProjectionPlan(const ProjectionSet& set, std::size_t direction, const Relief& relief, ScalarType scalar);

  /// `top` is the greatest rounded projection of p - center at the end, `reached` as ReachedProjections has
  /// it.
  EndSearch of(bool high, double top, double reached) const;

 private:
  bool is_float_;
  bool constant_;
  bool overflow_;
  double offset_;        // the projection of the centre
  double offset_doubt_;  // how far a point's rounded projection plus that offset may be off
  double band_;          // how far two points' rounded projections may be off together
};

/// Lets `best` compete with those valid points first, first + step, ... below `end` that pass the filter
/// along `scaled`.
void find_farthest(const PointView& points, std::size_t first, std::size_t step, std::size_t end,
                   const Direction& direction, const Direction& scaled, const RoundedFilter& filter,
                   FarthestPoint& best);

}  // namespace pcl_bv
