// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tests, in the scalar type of the points, which points are inside at least one of several convex regions.
// The test decides nearly all points. It leaves a point undecided in two cases: the point is within the error
// bound of a surface, or it is in the box of a region with coordinates so large that sums could overflow.
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

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// The shape of a region within its box low <= p <= high, with q = p - center.
enum class RegionShape : std::uint8_t {
  box,      ///< The whole box, exactly.
  slabs,    ///< |axes[i] . q| <= slab[i] for each i.
  ball,     ///< |q| <= radius.
  rounded,  ///< As `slabs`, and the sum of (weight[i] max(0, |axes[i] . q| - core[i]))^2 is <= radius^2.
  planes    ///< n . q <= limit for each half-space.
};

/// A convex region, which is a shape within a box. RegionShape says which members each shape uses.
struct ConvexRegion {
  RegionShape shape = RegionShape::box;
  Coordinates low{}, high{};  ///< A box that contains the region; infinite only for boxes and planes.
  Coordinates center{};

  /// Error bound of the surface that `center` and the members below describe. This surface differs from the
  /// true surface by at most surface_error + 2^-43 (|q|_1 + radius).
  double surface_error = 0;

  std::array<Direction, 3> axes{};  ///< Unit vectors to within 1e-11; so are the normals in `planes`.
  std::array<double, 3> slab = {std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::infinity()};
  std::array<double, 3> core{};
  std::array<double, 3> weight = {1, 1, 1};  ///< If a weight is infinite, no point is certainly inside.
  double radius = 0;
  /// If a normal and its limit are 0, no point is certainly inside.
  std::vector<HalfSpace> planes;
};

/// Regions prepared for tests in float and in double arithmetic. Copies are cheap, because they share the
/// data.
class RegionTests {
 public:
  explicit RegionTests(const std::vector<ConvexRegion>& regions);

  struct Prepared;
  const Prepared& prepared() const { return *prepared_; }

 private:
  std::shared_ptr<const Prepared> prepared_;
};

/// The result for one point and all regions.
enum class RegionState : std::uint8_t {
  outside = 0,  ///< Outside every region, or not a valid point.
  inside = 1,   ///< Inside at least one region.
  unclear = 2   ///< Too near a surface to decide, and not certainly inside any region.
};

/// Writes the RegionState of each visited point to states[0] ... states[points.count - 1]. The states are the
/// same for every `isa`. O(points * regions) at worst. Points outside the box around all regions cost little.
/// The caller must hold a FloatEnvironment. Throws std::invalid_argument if the points are not in memory.
void region_states(UsableIsa isa, const PointView& points, const RegionTests& regions, std::uint8_t* states);

/// A subset of the regions of a RegionTests, given by their indices.
struct ChosenRegions {
  const std::uint32_t* indices;
  std::size_t count;
};

/// As region_states() above, but tests only the chosen regions.
void region_states(UsableIsa isa, const PointView& points, const RegionTests& regions,
                   const ChosenRegions& chosen, std::uint8_t* states);

}  // namespace detail
}  // namespace pcl_bv
