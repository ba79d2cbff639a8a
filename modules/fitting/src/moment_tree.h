// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>

#include "pcl_bv/kernels/moments.h"
#include "small_vector.h"

namespace pcl_bv {

/// In larger units: what vanishes is nothing beside the sums in these units. `exponent` is not above theirs.
void coarsen(int exponent, Moments& moments);

/// About the origin of the first one, with the lesser exponent that leaves room for both.
Moments merged(const Moments& first, const Moments& second);

/// Of 2^k blocks, the first of which is a multiple of 2^k.
struct MomentNode {
  std::size_t first;
  std::size_t blocks;
  Moments moments;
};

/// Adds up the moments of blocks in pairs, of those pairs in pairs, and so on: which sums are formed depends
/// on the blocks' numbers alone. So parts of a cloud that are summed apart give the bits of the whole.
class MomentTree {
 public:
  /// Of block number `block`, which comes after those that are here.
  void append(std::size_t block, const Moments& moments) { append(MomentNode{block, 1, moments}); }

  /// Of blocks that come after those that are here.
  void append(const MomentNode& next);

  /// Of blocks that `tree` numbers from 0 on, here from `first` on: 0 or a power of two times its blocks.
  void append(std::size_t first, const MomentTree& tree);

  /// Of all blocks; a count of 0 if there is none.
  Moments total() const;

  /// Ascending. Which ones there are depends on the blocks alone.
  const MomentNode* begin() const { return nodes_.data(); }
  const MomentNode* end() const { return begin() + nodes_.size(); }

 private:
  SmallVector<MomentNode, 6> nodes_;  // a chunk's 32 blocks are at most 5 nodes, and one that is being added
};

/// Of the blocks of a chunk, the first of which has this number.
MomentTree moments_of(UsableIsa isa, const PointView& chunk, std::size_t first_block);

}  // namespace pcl_bv
