// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Counts allocations, for the promise that a stream of clouds needs none.
#pragma once

#include <cstddef>

namespace pcl_bv {

/// Calls of operator new so far in this program.
std::size_t allocations();

}  // namespace pcl_bv
