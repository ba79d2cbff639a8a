// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sums of the moments of blocks. The order of the additions depends on the block numbers alone.
#pragma once

#include <cstddef>

#include "pcl_bv/kernels/moments.h"
#include "small_vector.h"

namespace pcl_bv::detail {

/// Converts the moments to larger units. `exponent` is the new Moments::exponent, which must not be above the
/// present one. Values that underflow are negligible compared with the sums in the new units.
void coarsen(int exponent, Moments& moments);

/// Returns the moments of the points of `first` and `second`, about the origin of `first`. The exponent is
/// the smaller of the two exponents. If products of the distance between the origins could overflow, the
/// exponent is reduced further.
Moments merged(const Moments& first, const Moments& second);

/// The moments of 2^k successive blocks. The number of the first block is a multiple of 2^k.
struct MomentNode {
  std::size_t first;   ///< Number of the first block.
  std::size_t blocks;  ///< Number of blocks, 2^k.
  Moments moments;
};

/// Adds the moments of blocks in pairs, then these sums in pairs, and so on. The block numbers alone decide
/// which sums are formed. Therefore parts of a cloud that are summed separately give the same bits as the
/// whole cloud.
class MomentTree {
 public:
  /// Appends the block with number `block`, which must be higher than the numbers of all blocks appended
  /// before.
  void append(std::size_t block, const Moments& moments) { append(MomentNode{block, 1, moments}); }

  /// Appends a node. The numbers of its blocks must be higher than those of all blocks appended before.
  void append(const MomentNode& next);

  /// Appends the nodes of `tree` with `first` added to their block numbers. `first` must be 0 or a multiple
  /// of the number of blocks in each node. The resulting block numbers must be higher than those of all
  /// blocks appended before.
  void append(std::size_t first, const MomentTree& tree);

  /// Returns the moments of all blocks. If there is no block, the count is 0.
  Moments total() const;

  /// The nodes, in ascending order of their blocks. Which nodes exist depends on the appended blocks alone.
  const MomentNode* begin() const { return nodes_.data(); }
  const MomentNode* end() const { return begin() + nodes_.size(); }

 private:
  SmallVector<MomentNode, 6> nodes_;  // The 32 blocks of a chunk need at most 6: 5 nodes and an appended one.
};

/// Returns the moments of the blocks of a chunk. The first block of the chunk gets the number `first_block`.
MomentTree moments_of(UsableIsa isa, const PointView& chunk, std::size_t first_block);

}  // namespace pcl_bv::detail
