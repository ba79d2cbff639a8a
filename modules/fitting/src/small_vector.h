// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A vector that does not allocate memory while it is short. A sweep can have thousands of small clusters,
// whose fits must not allocate.
#pragma once

#include <boost/container/small_vector.hpp>

namespace pcl_bv::detail {

template <typename T, std::size_t N>
using SmallVector = boost::container::small_vector<T, N>;

}  // namespace pcl_bv::detail
