// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The candidate points from which sphere fits compute a smallest ball.
#pragma once

#include "local_frame.h"
#include "pcl_bv/fitting/small_ball.h"
#include "pcl_bv/fitting/supports.h"
#include "small_vector.h"

namespace pcl_bv {

/// Distinct points of a cloud: at first in ascending order of their indices, then in the order of add().
class SeedPoints {
 public:
  struct Seed {
    std::size_t index;
    Coordinates point;
  };

  /// The support points of all directions; the supports must have points.
  explicit SeedPoints(const Supports& supports);

  /// All valid points of a view of at most kChunkPoints points; `supports` are those of the view.
  SeedPoints(const PointView& points, const Supports& supports);

  std::size_t size() const { return seeds_.size(); }
  const Seed& operator[](std::size_t i) const { return seeds_[i]; }

  /// Appends a point. Returns false, and changes nothing, if the point is there already.
  bool add(std::size_t index, const Coordinates& point);

  /// Returns the smallest ball of the points, in local coordinates. `start`, if not null, is the ball of the
  /// first of these points.
  SmallBall smallest_ball(const LocalFrame& frame, const SmallBall* start = nullptr) const;

  /// Returns the largest squared distance of the points from `center`.
  double greatest_distance(const DistanceCenter& center) const;

 private:
  void make_unique();

  SmallVector<Seed, 128> seeds_;
};

}  // namespace pcl_bv
