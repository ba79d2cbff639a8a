// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The largest allocation of this test program: a small file must not take much memory.
#pragma once

#include <atomic>
#include <cstddef>

namespace pcl_bv {

/// Bytes; set it to 0 before what is to be watched.
extern std::atomic<std::size_t> largest_allocation;

}  // namespace pcl_bv
