// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/kernels/packed_tree.h"
#include "pcl_bv/kernels/point_view.h"
#include "spatial_order.h"

namespace pcl_bv {

/// A view's valid points, an array for each axis, and what sorting them needs.
template <typename T>
struct LoadedPlaces {
  std::array<std::vector<T>, 3> axis;
  std::vector<std::int32_t> numbers;
  PlaceBounds bounds{};
  std::size_t count = 0;

  ItemPlaces<T> places() const { return {{axis[0].data(), axis[1].data(), axis[2].data()}, count}; }
};

struct TreeScratch {
  LoadedPlaces<float> floats;
  LoadedPlaces<double> doubles;
  SpatialOrder order;
};

/// Replaces the tree by one of the view's valid points.
void build_tree(const PointView& points, const ParallelPolicy& policy, TreeScratch& scratch, PackedTree& tree);

/// Takes the coordinates of the tree's points from a cloud that has them all, and measures its boxes again.
void refit_tree(const PointView& cloud, const ParallelPolicy& policy, PackedTree& tree);

}  // namespace pcl_bv
