// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Which points are inside at least one of several convex regions, as far as arithmetic in the points' own
// type can tell; it can for all but those within rounding of a surface.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "pcl_bv/kernels/half_spaces.h"
#include "pcl_bv/kernels/isa.h"
#include "pcl_bv/kernels/point_view.h"
#include "pcl_bv/numeric/exact_dot.h"

namespace [[gnu::visibility("default")]] pcl_bv {

enum class RegionShape : std::uint8_t {
  box,    ///< All of low <= p <= high, exactly.
  body,   ///< Of that, what axes and radius hold.
  planes  ///< Of that, what is in all half-spaces.
};

/// A convex region, with q = p - center. Of a body: |axes[i] . q| <= slab[i] for each i, and the sum of
/// (weight[i] max(0, |axes[i] . q| - core[i]))^2 is at most radius^2. Of planes: n . q <= limit for each.
struct ConvexRegion {
  RegionShape shape = RegionShape::box;
  Coordinates low{}, high{};  ///< Inclusive; infinite where nothing is known. Holds the region.
  Coordinates center{};

  /// How far, besides 2^-43 of |q|_1, the region's surface may be from what the numbers below say.
  double doubt = 0;

  std::array<Direction, 3> axes{};  ///< Of length 1 to 1e-11.
  std::array<double, 3> slab = {std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::infinity()};
  std::array<double, 3> core{}, weight{};  ///< Weights may be infinite: then it cannot be told.
  double radius = std::numeric_limits<double>::infinity();
  std::vector<HalfSpace> planes;  ///< Normals of length 1 to 1e-11.
};

/// Regions as float and double arithmetic tests them. Cheap to copy.
class RegionTests {
 public:
  explicit RegionTests(const std::vector<ConvexRegion>& regions);

  struct Prepared;
  const Prepared& prepared() const { return *prepared_; }

 private:
  std::shared_ptr<const Prepared> prepared_;
};

enum class RegionState : std::uint8_t {
  outside = 0,  ///< Of every region, or not a valid point.
  inside = 1,   ///< Of at least one.
  unclear = 2   ///< Too near a surface to tell, and surely inside of none.
};

/// Writes each visited point's RegionState: states[0] ... states[points.count - 1]. The same for every `isa`.
/// O(points * regions) at worst; regions whose boxes are elsewhere cost little. Runs in the caller's
/// floating-point environment: hold a FloatEnvironment. Throws std::invalid_argument unless the points are in
/// memory.
void region_states(UsableIsa isa, const PointView& points, const RegionTests& regions, std::uint8_t* states);

}  // namespace pcl_bv
