// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What the vectors are told before their pass over points, and what follows from it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "pcl_bv/kernels/support.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv {

template <typename Vector>
Direction magnitudes(const Vector& v) {
  return {std::abs(v[0]), std::abs(v[1]), std::abs(v[2])};
}

/// How far the double dot product of a scaled direction and a point may be off: its own rounding, that of the
/// direction's tiny components, underflow.
inline double double_error(const Direction& scaled, const Coordinates& p) {
  return (0x1p-50 * dot3(magnitudes(scaled), magnitudes(p)) + 0x1p-1074 * taxicab3(p)) + kSmallestNormal;
}

/// A valid point amid the others, to which projections are relative: then zero is reached at every end, and
/// rounding errors are those of the extent, not of the place (UTM). False if there is no valid point.
bool central_point(const PointView& points, Coordinates& center);

/// What the pass over some points saw.
struct Spread {
  Coordinates center{};
  std::array<double, 3> greatest{};  ///< Magnitudes of p - center, as rounded.
};

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

/// What follows for the two ends of a direction. Keeps the set and the spread.
class SupportPlan {
 public:
  SupportPlan(const SupportDirections& set, std::size_t direction, const Spread& spread, ScalarType scalar);

  /// `top` is the greatest rounded projection of p - center at the end, `reached` as ReachedSupports has it.
  EndSearch of(bool high, double top, double reached) const;

 private:
  bool reaches(bool high, double top, double reached) const;

  const Direction& scaled_;
  const Coordinates& center_;
  bool is_float_;
  bool constant_;
  bool overflow_;
  double size_;        // what a projection of p - center can be
  double error_;       // of such a projection
  double pair_error_;  // of the difference of two
};

/// Which points are worth an exact look: those whose rounded projection, relative to `center` and in the
/// view's scalar type, is at least `threshold` (a value of that type).
struct RoundedFilter {
  Coordinates center;
  double threshold;
};

/// The valid point with the smallest index: what competes for an end at which all are equal.
SupportPoint first_valid_point(const PointView& points);

/// An exact look at points of one end. T is the scalar of the points. Keeps the points.
template <typename T>
class SupportLook {
 public:
  SupportLook(const PointView& points, const SupportDirections& set, std::size_t end,
              const RoundedFilter& filter);

  /// Lets `best` compete with those valid points first, first + step, ... below `last` that pass the filter.
  void operator()(std::size_t first, std::size_t step, std::size_t last, SupportPoint& best) const;

 private:
  template <typename Address>
  void find_passing(const Address& address, std::size_t gap, std::size_t first, std::size_t step,
                    std::size_t last, SupportPoint& best) const;
  void compete(std::size_t i, SupportPoint& best) const;

  const PointView& points_;
  Direction direction_;
  T threshold_;
  std::array<T, 3> scaled_, center_;
};

/// The kernels behind chunk_supports(): for the directions of the cube and for others.
void cube_supports(UsableIsa isa, const PointView& chunk, const SupportDirections& set,
                   const ReachedSupports& reached, ChunkSupports& out);
void own_supports(UsableIsa isa, const PointView& chunk, const SupportDirections& set,
                  const ReachedSupports& reached, ChunkSupports& out);

}  // namespace pcl_bv
