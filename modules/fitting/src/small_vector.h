// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A list without an allocation as long as it is short: fits of small clusters, of which there are thousands
// in a sweep, must not ask the allocator for anything.
#pragma once

#include <boost/container/small_vector.hpp>

namespace pcl_bv {

template <typename T, std::size_t N>
using SmallVector = boost::container::small_vector<T, N>;

}  // namespace pcl_bv
