// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "pcl_bv/kernels/packed_tree.h"
#include "pcl_bv/trees/point_tree.h"
#include "tree_build.h"

namespace pcl_bv {

/// The points and boxes of a PointTree.
struct PointTree::State {
  detail::PackedTree tree;
  UsableIsa isa = Isa::scalar;
  std::size_t dropped = 0;
  detail::TreeScratch scratch;  // retained for the next cloud, and not copied
};

}  // namespace pcl_bv
