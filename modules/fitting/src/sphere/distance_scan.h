// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Compares the distances of a cloud's points from a centre with a radius, in parallel. Finds the points
// outside, their distances, and the points that need not be inspected again.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <vector>

#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/smallest_sphere.h"
#include "pcl_bv/kernels/distances.h"
#include "pcl_bv/points/point_source.h"
#include "small_vector.h"

namespace pcl_bv::detail {

/// The largest squared distance of a point in each block.
using BlockMaxima = SmallVector<double, 16>;

/// Scans of a cloud for points far from a centre. All squared distances are squared_distance() of the
/// kernels. No result depends on the execution.
class DistanceScan {
 public:
  /// Copies the view and the execution, not the points.
  DistanceScan(const PointView& points, const FitExecution& execution);

  const PointView& points() const { return points_; }

  /// Returns whether a pass over all points would run in one thread.
  bool serial() const;

  /// Returns whether a device rejects blocks (FitExecution::far_blocks).
  bool has_device() const { return far_blocks_ != nullptr; }

  /// Sets `maxima` to the largest squared distance of a valid point in each block. If that distance is below
  /// `limit`, the value is -1.
  void block_maxima(const DistanceCenter& center, double limit, BlockMaxima& maxima) const;

  /// Returns the largest squared distance of a valid point, or `at_least` if that is larger.
  double greatest(const DistanceCenter& center, double at_least) const;

  /// Calls visit(i, p) for the valid points p of a block with a squared distance of at least `limit`, in
  /// ascending order of their positions i in the block.
  template <typename Visit>
  void visit_block(std::size_t block, const DistanceCenter& center, double limit, const Visit& visit) const {
    const LoadedPoints part = blocks(block, 1);
    std::array<std::uint32_t, kBlockPoints> listed;
    const std::size_t count = list_distant(isa_, part.view(), center, limit, filter_, listed.data());
    for (std::size_t i = 0; i < count; ++i)
      visit(listed[i], load_point(part.view(), listed[i]));
  }

  /// Answers a query as FarthestQuery does. Fastest if the centre hardly moves between calls. A scan of all
  /// points also lists the points near the surface, or stores upper bounds of distances, each for a group of
  /// points. If only few points can have a distance above the limit, later calls inspect only these points.
  bool farthest(const FarQuery& query, OctantPoints& found);

 private:
  class SharedOctants;

  ParallelPolicy policy(std::size_t expected_blocks) const;
  // Calls visit(first block, number of blocks) for runs of consecutive blocks, which together have all points
  // with a squared distance of at least `limit`: all chunks or, with a device, the blocks that it does not
  // reject.
  template <typename Visit>
  void visit_far_blocks(const DistanceCenter& center, double limit, const Visit& visit) const {
    visit_runs(center, limit, std::cref(visit));  // a reference, because a copy would be allocated
  }
  void visit_runs(const DistanceCenter& center, double limit,
                  const std::function<void(std::size_t first, std::size_t count)>& visit) const;
  LoadedPoints blocks(std::size_t first, std::size_t count) const;
  void scan_all(const DistanceCenter& center, double limit, OctantPoints& found);
  void scan_chunk(std::size_t first, std::size_t count, const DistanceCenter& center, double limit,
                  SharedOctants& best);
  // Whether scan_all() stores bounds. It has none for points of a source, because every scan has to load all
  // points of a source, and none with a device.
  bool has_bounds() const {
    return filter_ == FloatFilter::reject && points_.source == nullptr && !has_device();
  }
  void scan_sample(const FarQuery& query, OctantPoints& found);
  double near_surface(const DistanceCenter& center, double limit, bool& crowded) const;
  bool scan_and_list(const DistanceCenter& center, double limit, OctantPoints& found);
  bool list_shell(const DistanceCenter& center, double distance);
  void scan_shell(const DistanceCenter& center, double limit, OctantPoints& found) const;

  PointView points_;
  ParallelPolicy parallel_;
  UsableIsa isa_;
  FloatFilter filter_;
  std::size_t blocks_;
  const FarBlocks* far_blocks_;

  std::unique_ptr<float[]> bounds_;  // upper bounds of distances from scan_center_, set by scan_all()
  DistanceCenter scan_center_;
  bool scanned_ = false;

  std::list<LoadedPoints> sample_;  // the runs of positions in the sample sample_one_of_, which is 1 if unset
  std::size_t sample_one_of_ = 1;

  // If listed_: all points whose distance from shell_center_ is at least shell_distance_.
  std::vector<FarPoint> shell_;
  DistanceCenter shell_center_;
  double shell_distance_ = 0;
  bool listed_ = false;
  bool crowded_surface_ = false;  // whether scan_and_list() found too many points to list
};

}  // namespace pcl_bv::detail
