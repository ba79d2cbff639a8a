// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A cloud's points against a radius, block by block and over the cores: what is outside, how far, and what
// need not be looked at again.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/fitting/smallest_sphere.h"
#include "pcl_bv/kernels/distances.h"
#include "pcl_bv/points/point_source.h"
#include "small_vector.h"

namespace pcl_bv {

/// One number for each block.
using BlockNumbers = SmallVector<double, 16>;

/// All squared distances are squared_distance() of the kernels. No result depends on the execution.
class DistanceScan {
 public:
  /// Keeps the view and the execution.
  DistanceScan(const PointView& points, const Execution& execution);

  const PointView& points() const { return points_; }

  /// Whether a pass over all points would run in one thread.
  bool serial() const;

  /// For each block the greatest squared distance of a valid point that is at least `limit`; -1 if there is
  /// none.
  void bound(const DistanceCenter& center, double limit, BlockNumbers& bounds) const;

  /// The greatest squared distance of a valid point, or `at_least` if that is greater.
  double greatest(const DistanceCenter& center, double at_least) const;

  /// Calls visit(position in the block, p) for those of one block, in order.
  template <typename Visit>
  void visit_block(std::size_t block, const DistanceCenter& center, double limit, const Visit& visit) const {
    const LoadedPoints part = blocks(block, 1);
    std::array<std::uint32_t, kBlockPoints> listed;
    const std::size_t count = list_distant(isa_, part.view(), center, limit, filter_, listed.data());
    for (std::size_t i = 0; i < count; ++i)
      visit(listed[i], load_point(part.view(), listed[i]));
  }

  /// As FarthestPoints says. For spheres that hardly move between calls: the first one keeps how far every
  /// few points reach, and later ones look only at those that can have come to reach the limit, if they are
  /// few.
  bool farthest(const DistanceCenter& center, double limit, OctantPoints& found);

 private:
  class SharedOctants;

  ParallelPolicy policy(std::size_t expected_blocks) const;
  template <typename Visit>
  void visit_chunks(std::size_t expected_blocks, const Visit& visit) const;
  LoadedPoints blocks(std::size_t first, std::size_t count) const;
  void scan_all(const DistanceCenter& center, double limit, OctantPoints& found);
  void scan_chunk(std::size_t first, std::size_t count, const DistanceCenter& center, double limit,
                  SharedOctants& best);
  bool list_shell(const DistanceCenter& center, double distance);
  void scan_shell(const DistanceCenter& center, double limit, OctantPoints& found) const;

  PointView points_;
  ParallelPolicy parallel_;
  UsableIsa isa_;
  FloatFilter filter_;
  std::size_t blocks_;

  std::unique_ptr<float[]> bounds_;  // of the first scan, from first_center_
  DistanceCenter first_center_;
  bool scanned_ = false;

  // All points not nearer than shell_distance_ to shell_center_, by position, if listed_.
  std::vector<std::size_t> shell_;
  DistanceCenter shell_center_;
  double shell_distance_ = 0;
  bool listed_ = false;
};

}  // namespace pcl_bv
