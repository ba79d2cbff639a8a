// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Copies the valid points of a PointView to an array, in ascending order of their index.
#pragma once

#include <cstdint>
#include <vector>

#include "distance.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/parallel/parts.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv::detail {

/// A part of the points of a view. One thread copies it.
template <typename T>
struct CopyPart {
  std::size_t begin, end;
  std::size_t valid;  ///< Number of valid points.
  Box<T> box;         ///< Box of the valid points.
};

template <typename T>
struct ValidPoints {
  std::vector<Point<T>> points;
  std::vector<std::int32_t> numbers;      ///< Index in the cloud of each point; strictly ascending.
  Box<T> box;                             ///< Box of the points; undefined if there are none.
  std::vector<std::int32_t> sorted_list;  ///< Buffer for a sorted copy of the view's index list.
  PointParts<CopyPart<T>> parts;
};

/// Fills `valid` with each valid point of `view` once. T must be the scalar type of the view. Throws
/// std::length_error if a point index exceeds 2^31 - 1.
template <typename T>
void copy_valid_points(const PointView& view, const ParallelPolicy& policy, ValidPoints<T>& valid);

}  // namespace pcl_bv::detail
