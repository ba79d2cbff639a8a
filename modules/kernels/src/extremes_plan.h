// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What the vectors of extremes.cpp are told before their pass over a chunk, and what follows from it.
#pragma once

#include <array>
#include <cstddef>

#include "pcl_bv/kernels/extremes.h"

namespace pcl_bv {

/// A place amid the chunk's valid points, a float in a float cloud, to which projections are relative: then
/// zero is inside every extent, and rounding errors are those of the extent, not of the place (UTM). The mean
/// of at most 16 of the points. False if there is no valid point.
bool chunk_center(const PointView& chunk, Coordinates& center);

/// The greatest rounded projections of a chunk relative to its centre, not below 0.
using RoundedEnds = std::array<double, kMaxEnds>;

/// What is left to look at for one end.
struct EndSearch {
  enum class Kind {
    none,   ///< The end cannot beat `reached`.
    every,  ///< All valid points have exactly the same projection.
    some    ///< The points whose rounded projection is at least the threshold.
  };
  Kind kind = Kind::none;
  double threshold = 0;  ///< A value of the view's scalar type.
};

class SearchPlan {
 public:
  SearchPlan(DirectionSet set, const RoundedEnds& top, const Coordinates& center, ScalarType scalar);

  /// `reached` as ReachedEnds has it.
  EndSearch of(std::size_t end, double reached) const;

 private:
  DirectionSet set_;
  const RoundedEnds& top_;
  Coordinates center_;
  bool is_float_;
  double magnitude_;  // sum of the greatest coordinates' magnitudes, relative to the centre
  double offset_error_;
};

/// The valid point with the smallest index: what competes for an end at which all are equal. False without
/// one.
bool first_valid_point(const PointView& points, Coordinates& point, std::size_t& index);

}  // namespace pcl_bv
