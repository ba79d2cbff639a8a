// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "local_frame.h"
#include "pcl_bv/fitting/small_ball.h"
#include "pcl_bv/fitting/supports.h"
#include "small_vector.h"

namespace pcl_bv {

/// Points of a cloud, each once, in the order of their indices until some are added.
class SeedPoints {
 public:
  struct Seed {
    std::size_t index;
    Coordinates point;
  };

  /// The points of both ends of all of the supports' directions, which must have been asked for.
  explicit SeedPoints(const Supports& supports);

  /// All valid points, with their supports.
  SeedPoints(const PointView& points, const Supports& supports);

  std::size_t size() const { return seeds_.size(); }
  const Seed& operator[](std::size_t i) const { return seeds_[i]; }

  /// False, and nothing changes, if the point is there already.
  bool add(std::size_t index, const Coordinates& point);

  /// Their smallest ball, in local coordinates. `start`: that of all but the last of them.
  SmallBall smallest_ball(const LocalFrame& frame, const SmallBall* start = nullptr) const;

  /// The greatest squared distance of any.
  double greatest_distance(const DistanceCenter& center) const;

 private:
  void make_unique();

  SmallVector<Seed, 128> seeds_;
};

}  // namespace pcl_bv
