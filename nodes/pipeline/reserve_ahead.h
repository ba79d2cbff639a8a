// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <vector>

namespace pcl_bv::detail {

/// Reserves twice `count`, if the capacity is smaller than `count`. The replay of a sequence must not allocate,
/// but its first frames can have more objects than before: the tracks of the first pass cut more clusters.
template <typename T>
void reserve_ahead(std::vector<T>& values, std::size_t count) {
  if (values.capacity() < count) values.reserve(2 * count);
}

}  // namespace pcl_bv::detail
