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
#include "pcl_bv/numeric/exact_dot.h"
#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What of the box low <= p <= high, with q = p - center, a region is.
enum class RegionShape : std::uint8_t {
  box,    ///< All of it, exactly.
  slabs,  ///< |axes[i] . q| <= slab[i] for each i.
  ball,   ///< |q| <= radius.
  body,   ///< As slabs; and the sum of (weight[i] max(0, |axes[i] . q| - core[i]))^2 is at most radius^2.
  planes  ///< n . q <= limit for each half-space.
};

struct ConvexRegion {
  RegionShape shape = RegionShape::box;
  Coordinates low{}, high{};  ///< Holds the region; infinite only for boxes and planes.
  Coordinates center{};

  /// How far, besides 2^-43 of |q|_1 and of the radius, the surface may be from what the numbers say.
  double doubt = 0;

  std::array<Direction, 3> axes{};  ///< Of length 1 to 1e-11, as normals are.
  std::array<double, 3> slab = {std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::infinity()};
  std::array<double, 3> core{};
  std::array<double, 3> weight = {1, 1, 1};  ///< If infinite, the surface cannot be told.
  double radius = 0;
  std::vector<HalfSpace> planes;
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

/// Some of the regions, by their places among those of RegionTests.
struct ChosenRegions {
  const std::uint32_t* places;
  std::size_t count;
};

/// Likewise, as if there were no other regions.
void region_states(UsableIsa isa, const PointView& points, const RegionTests& regions,
                   const ChosenRegions& chosen, std::uint8_t* states);

}  // namespace pcl_bv
