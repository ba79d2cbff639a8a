// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Builds the PackedTree of a PointTree.
#pragma once

#include "pcl_bv/kernels/packed_tree.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/parallel/parts.h"
#include "pcl_bv/points/point_view.h"
#include "spatial_order.h"

namespace pcl_bv::detail {

/// A part of the points. One thread loads it.
struct LoadPart {
  std::size_t begin = 0, end = 0;  ///< Range of the points.
  std::size_t valid = 0;           ///< Number of valid points, stored from `begin` on.
};

/// A part of the packets. One thread fills it.
struct PacketPart {
  std::size_t begin = 0, end = 0;  ///< Range of the packets.
  PositionBounds bounds{};
};

/// Buffers for building and refitting a tree. They are reused for the next cloud.
struct TreeScratch {
  PointParts<LoadPart> loads;
  PointParts<PacketPart> packets;
  SpatialOrder<float> floats;
  SpatialOrder<double> doubles;
};

/// Replaces the tree by the tree of the view's valid points.
void build_tree(const PointView& points, const ParallelPolicy& policy, TreeScratch& scratch,
                PackedTree& tree);

/// Reads new coordinates of the tree's points from a cloud that has all of them, and recomputes the boxes.
void refit_tree(const PointView& cloud, const ParallelPolicy& policy, TreeScratch& scratch, PackedTree& tree);

}  // namespace pcl_bv::detail
