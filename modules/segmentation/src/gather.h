// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// From a PointView to its valid points in a row, ascending by point number.
#pragma once

#include <cstdint>
#include <vector>

#include "distance.h"
#include "pcl_bv/parallel/parts.h"
#include "pcl_bv/parallel/policy.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv {

/// Points of a view that one thread takes.
template <typename T>
struct GatherPart {
  std::size_t begin, end;
  std::size_t kept;  ///< Valid ones.
  Box<T> box;        ///< Of these.
};

template <typename T>
struct ValidPoints {
  std::vector<Point<T>> points;
  std::vector<std::int32_t> numbers;      ///< Number in the cloud of each point; strictly ascending.
  Box<T> box;                             ///< Of the points; of no meaning if there are none.
  std::vector<std::int32_t> sorted_list;  ///< Room for a sorted copy of the view's index list.
  Parts<GatherPart<T>> parts;
};

/// Fills `valid` with each valid point of `view` once. T is the scalar of the view. Throws std::length_error
/// if a point number exceeds 2^31 - 1.
template <typename T>
void gather(const PointView& view, const ParallelPolicy& policy, ValidPoints<T>& valid);

}  // namespace pcl_bv
