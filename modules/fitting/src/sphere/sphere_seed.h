// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The candidate points from which sphere fits compute a smallest ball.
#pragma once

#include "local_frame.h"
#include "pcl_bv/fitting/small_ball.h"
#include "pcl_bv/fitting/supports.h"
#include "small_vector.h"

namespace pcl_bv::detail {

/// Distinct points of a cloud. Points from the constructor come first, in ascending order of their indices.
/// Points from add() follow in the order of the calls.
class SeedPoints {
 public:
  struct Seed {
    std::size_t index;
    Coordinates point;
  };

  /// Takes the support points of all directions. `supports` must have SupportDetail::points.
  explicit SeedPoints(const Supports& supports);

  /// Takes all valid points of a view of at most kChunkPoints points. `supports` must be those of the view.
  SeedPoints(const PointView& points, const Supports& supports);

  std::size_t size() const { return seeds_.size(); }
  const Seed& operator[](std::size_t i) const { return seeds_[i]; }

  /// Appends a point. If a point with this index is present already, returns false and changes nothing.
  bool add(std::size_t index, const Coordinates& point);

  /// Returns the smallest ball of the points, in local coordinates. `start`, if not null, is the result of an
  /// earlier call, after which points may have been added.
  SmallBall smallest_ball(const LocalFrame& frame, const SmallBall* start = nullptr) const;

  /// Returns the smallest ball of the support of a ball from smallest_ball(). Its bits depend only on the
  /// points of the support, and not on how the support was found.
  SmallBall ball_of_support(const LocalFrame& frame, const SmallBall& ball) const;

  /// Returns the largest squared distance of the points from `center`.
  double greatest_distance(const DistanceCenter& center) const;

 private:
  void make_unique();

  SmallVector<Seed, 128> seeds_;
};

}  // namespace pcl_bv::detail
