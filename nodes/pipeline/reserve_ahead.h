// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <vector>

namespace pcl_bv::detail {

/// Reserves 2 * count if the capacity is below `count`, so that a replay with a few more objects allocates
/// nothing. The first frames of a replay can have more objects than before, because the tracks of the first
/// pass cut more clusters.
template <typename T>
void reserve_ahead(std::vector<T>& values, std::size_t count) {
  if (values.capacity() < count) values.reserve(2 * count);
}

}  // namespace pcl_bv::detail
