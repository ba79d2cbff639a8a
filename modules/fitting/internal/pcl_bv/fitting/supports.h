// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Exact minimum and maximum projections of a cloud along directions, and the points with these projections.
// Boxes, k-DOPs and the first balls of sphere fits are computed from these values.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pcl_bv/fitting/result.h"
#include "pcl_bv/kernels/support.h"
#include "pcl_bv/numeric/directions.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Minimum and maximum projection n . p of all points p along one direction n. The unit is that of the
/// coordinates times the length of n.
struct Support {
  double low = 0;           ///< Exact minimum of n . p, rounded down to a double; never -0.
  double high = 0;          ///< Exact maximum of n . p, rounded up to a double; never -0.
  SupportPoint low_point;   ///< The point with the minimum n . p. Of several, that with the smallest index.
  SupportPoint high_point;  ///< The point with the maximum n . p. Of several, that with the smallest index.
};

/// Supports along the directions of a set, in the order of the set. A set of all directions has 1.4 kB, and
/// the three of a box 0.3 kB, so only the elements in use are initialised and copied: for a box of 300
/// points, zeros and copies of all took a tenth of the time.
class SupportList {
 public:
  SupportList() {}
  /// `size` supports of zero; at most kMaxDirections.
  explicit SupportList(std::size_t size) : size_(size) { std::fill_n(elements_, size, Support()); }
  SupportList(const SupportList& other) { *this = other; }
  SupportList& operator=(const SupportList& other) {
    size_ = other.size_;
    std::copy_n(other.elements_, size_, elements_);
    return *this;
  }
  ~SupportList() = default;

  std::size_t size() const { return size_; }
  Support& operator[](std::size_t k) { return elements_[k]; }
  const Support& operator[](std::size_t k) const { return elements_[k]; }

 private:
  std::size_t size_ = 0;
  union {
    Support elements_[kMaxDirections];
  };
};

/// What to find along each direction.
enum class SupportDetail {
  bounds,  ///< Minimum and maximum only. Along the coordinate axes this is four times as fast as `points`.
  points   ///< Also the points with the minimum and maximum projection.
};

struct DistanceCenter;
struct LocalHull;
struct Moments;

/// Supports of a cloud along directions of the cube.
struct Supports {
  DirectionSet set = DirectionSet::dop6;         ///< The directions.
  SupportDetail detail = SupportDetail::bounds;  ///< Whether the support points are stored, too.
  std::size_t used = 0;                          ///< Number of valid points.
  std::size_t dropped = 0;                       ///< Number of points that are not valid (is_valid()).
  int rank = 0;                                  ///< Rank of the points, as EstimationResult defines it.
  /// Element k is along the k-th direction of the set, kCubeDirections[cube_direction(set, k)].
  SupportList along = SupportList(direction_count(DirectionSet::dop6));
  PointView points;                       ///< The view that was searched. Fits to other views throw.
  std::shared_ptr<const LocalHull> hull;  ///< The convex hull, if share_supports() computed it; else null.
  /// Usually null. Set if `points` are only the few points that represent a whole cloud (partial.h). In this
  /// case the moments, `used` and `dropped` are those of the whole cloud.
  std::shared_ptr<const Moments> moments;
};

/// Rejects blocks of a cloud that are near a centre, on a device other than the processor.
class FarBlocks {
 public:
  virtual ~FarBlocks() = default;

  /// Sets `blocks` to the numbers, ascending, of blocks of kBlockPoints points. These are all blocks that
  /// have a valid point with a squared_distance() (kernels/distances.h) of at least `limit` from the centre,
  /// and maybe others. Returns false if the processor has to scan all blocks. Several threads may call find()
  /// at a time. May throw.
  virtual bool find(const DistanceCenter& center, double limit, std::vector<std::uint32_t>& blocks) const = 0;
};

/// An Execution, and optionally what is known about the points, which saves a fit passes over them.
struct FitExecution : Execution {
  FitExecution() = default;
  FitExecution(const Execution& execution, const Supports* known = nullptr)
      : Execution(execution), supports(known) {}

  /// The result of find_supports() for the points of the fit, or null. A fit saves a pass over the points if
  /// `supports` has the directions and the detail that the fit needs. The fit throws std::invalid_argument if
  /// the supports were found for another view (same_memory() in point_view.h).
  const Supports* supports = nullptr;

  /// Rejects blocks of the points of the fit, or is null. Spheres then only inspect the other blocks.
  const FarBlocks* far_blocks = nullptr;
};

/// Finds the supports of all valid points along the directions of `set`. Without a valid point, `used` is 0
/// and all values of `along` are 0. The bits are the same for every execution.
///
/// Takes one SIMD pass over the points in chunks. The few points of each chunk that can be extreme are
/// compared exactly (docs/numerics.md). If FitExecution::supports already has the supports, no pass is
/// needed. Throws std::invalid_argument if FitExecution::supports were found for other points. If the points
/// are flat to 2^-30 of their extent, the rank can take up to five more passes (point_rank()).
Supports find_supports(const PointView& points, DirectionSet set, SupportDetail detail,
                       const FitExecution& execution = {});

/// Returns FitExecution::supports if it is not null. Otherwise finds the box of the points, stores it in
/// `own` and returns `own`. The first three elements are the bounds along the coordinate axes; others may be
/// missing. Throws std::invalid_argument if FitExecution::supports are those of other points.
const Supports& find_box(const PointView& points, const FitExecution& execution,
                         std::optional<Supports>& own);

/// Returns the supports that find_supports() finds for `points` with SupportDetail::points, if the caller has
/// rejected points. `candidates` must have every support point, as views of parts of `points` with at most
/// kChunkPoints points each: slices, or copies with the indices of the cloud. `dropped` is the number of
/// points of the cloud that are not valid. `points` is only read for the rank.
Supports find_supports_among(const PointView& points, const std::vector<PointView>& candidates,
                             DirectionSet set, std::size_t dropped, const FitExecution& execution);

/// Returns the supports that find_supports() finds for `points` along dop6 with SupportDetail::bounds, from
/// the smallest and largest coordinates of the valid points. `points` is only read for the rank.
Supports supports_of_bounds(const PointView& points, const std::array<float, 3>& low,
                            const std::array<float, 3>& high, std::size_t dropped,
                            const FitExecution& execution);

/// Returns the axis-aligned box, or the k-DOP along all directions of supports.set. The volume is empty
/// without a valid point.
Aabb aabb_of(const Supports& supports);
Kdop kdop_of(const Supports& supports);

/// Returns the status, the rank and the counts of the points.
EstimationResult result_of(const Supports& supports);

/// Supports of a cloud along user-defined directions.
struct CustomSupports {
  std::size_t used = 0;        ///< Number of valid points.
  std::size_t dropped = 0;     ///< Number of points that are not valid (is_valid()).
  std::vector<Support> along;  ///< Supports in the order of the directions; empty if no point is valid.
};

/// Finds the supports along directions of any length. Directions may repeat and may be opposite.
/// O(points * directions). If the extent of a float cloud is below 1e-43 or above 1e38, all points are
/// compared exactly, which takes 50 ns for each point and direction.
///
/// There must be 1 to 49 directions. Each direction must be finite, with its largest component between 1e-30
/// and 1e30 in magnitude. Throws std::invalid_argument for other directions, and if FitExecution::supports
/// were found for other points.
CustomSupports find_supports(const PointView& points, const std::vector<std::array<double, 3>>& directions,
                             const FitExecution& execution = {});

}  // namespace detail
}  // namespace pcl_bv
