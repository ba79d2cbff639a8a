// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Error bounds of rounded projections, and the exact comparison of the points that may be supports.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "pcl_bv/kernels/support.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {

template <typename Vector>
Direction magnitudes(const Vector& v) {
  return {std::abs(v[0]), std::abs(v[1]), std::abs(v[2])};
}

/// Returns an error bound of the dot product, in double, of a scaled direction and a point. It covers the
/// rounding of the dot product, the rounding of the direction's tiny components, and underflow.
inline double double_error(const Direction& scaled, const Coordinates& p) {
  return (0x1p-50 * dot3(magnitudes(scaled), magnitudes(p)) + 0x1p-1074 * taxicab3(p)) + kSmallestNormal;
}

/// Finds a valid point near the middle of the points. The kernels project all points relative to this point.
/// So no maximum projection is below 0. Rounding errors then depend on the extent of the points, not on their
/// position, which may be far from the origin (UTM). Returns false if no point is valid.
bool central_point(const PointView& points, Coordinates& center);

/// The centre and the extent of the points that a pass has projected.
struct CenteredExtent {
  Coordinates center{};
  std::array<double, 3> max_magnitude{};  ///< Largest rounded magnitudes of p - center.
};

/// Which points must be compared exactly for one support.
struct SupportCandidates {
  enum class Kind {
    none,   ///< No point, because the support is below its bound.
    every,  ///< All valid points have exactly the same projection.
    some    ///< The points whose rounded projection is at least the threshold.
  };
  Kind kind = Kind::none;
  double threshold = 0;  ///< A value of the view's scalar type.
};

/// Determines the candidates for the two supports of a direction. Stores references to the set and the
/// extent.
class SupportPlan {
 public:
  SupportPlan(const SupportDirections& set, std::size_t direction, const CenteredExtent& extent,
              ScalarType scalar);

  /// Returns the candidates for the maximum if `high`, else for the minimum. `top` is the largest rounded
  /// projection of p - center on the support direction. `bound` is the support's element of SupportBounds.
  SupportCandidates of(bool high, double top, double bound) const;

 private:
  bool may_exceed(bool high, double top, double bound) const;

  const Direction& scaled_;
  const Coordinates& center_;
  bool is_float_;
  bool constant_;
  bool overflow_;
  double size_;        // bound of the magnitude of a projection of p - center
  double error_;       // error bound of a projection
  double pair_error_;  // error bound of the difference of two projections
};

/// Selects the points that are compared exactly. These are the points whose rounded projection, relative to
/// `center` and in the view's scalar type, is at least `threshold` (a value of that type).
struct RoundedFilter {
  Coordinates center;
  double threshold;
};

/// Returns the valid point with the smallest index, which is the support if all projections are equal.
SupportPoint first_valid_point(const PointView& points);

/// Compares points exactly for one support. T is the points' scalar type. Stores a reference to the points.
template <typename T>
class ExactSupportSearch {
 public:
  ExactSupportSearch(const PointView& points, const SupportDirections& set, std::size_t support,
                     const RoundedFilter& filter);

  /// Updates `best` with the valid points among first, first + step, ... below `last` that pass the filter.
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

/// The kernels of chunk_supports(). cube_supports() takes the directions of a DirectionSet,
/// general_supports() takes any directions.
void cube_supports(UsableIsa isa, const PointView& chunk, const SupportDirections& set,
                   const SupportBounds& bounds, ChunkSupports& out);
void general_supports(UsableIsa isa, const PointView& chunk, const SupportDirections& set,
                      const SupportBounds& bounds, ChunkSupports& out);

}  // namespace pcl_bv::detail
