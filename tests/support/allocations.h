// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What a test program allocates, for the promises that a stream of clouds needs nothing and a damaged file little.
// Programs that ask compile allocations.cpp.
#pragma once

#include <atomic>
#include <cstddef>

namespace pcl_bv {

/// Calls of operator new so far in this program.
std::size_t allocations();

/// The bytes that they were asked for, in total.
std::size_t allocated_bytes();

/// The most bytes that one of them was asked for; may be set to 0.
extern std::atomic<std::size_t> largest_allocation;

}  // namespace pcl_bv
