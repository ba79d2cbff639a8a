// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/kernels/packed_tree.h"
#include "pcl_bv/parallel/parts.h"
#include "pcl_bv/points/point_view.h"
#include "spatial_order.h"

namespace pcl_bv {

struct LoadPart {
  std::size_t begin = 0, end = 0;  ///< Points.
  std::size_t valid = 0;           ///< Of them; they are stored from `begin` on.
};

struct PacketPart {
  std::size_t begin = 0, end = 0;  ///< Packets.
  PlaceBounds bounds{};
};

/// What building and measuring need, kept for the next cloud.
struct TreeScratch {
  Parts<LoadPart> loads;
  Parts<PacketPart> packets;
  SpatialOrder<float> floats;
  SpatialOrder<double> doubles;
};

/// Replaces the tree by one of the view's valid points.
void build_tree(const PointView& points, const ParallelPolicy& policy, TreeScratch& scratch,
                PackedTree& tree);

/// Takes the coordinates of the tree's points from a cloud that has them all, and measures its boxes again.
void refit_tree(const PointView& cloud, const ParallelPolicy& policy, TreeScratch& scratch, PackedTree& tree);

}  // namespace pcl_bv
