// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A guard against programs that set flush-to-zero, which would turn a coordinate of 1e-41 into 0. Public
// functions that compute hold a FloatEnvironment, and so does each thread in a parallel region
// (for_each_chunk()). Private functions hold none.
#pragma once

#include <cstdint>

namespace [[gnu::visibility("default")]] pcl_bv {

/// Sets the calling thread's floating-point environment to the IEEE default while the object lives. Denormals
/// are preserved (no FTZ, no DAZ), rounding is to nearest, and no exception traps. The destructor restores
/// the previous environment. If the previous environment is the default, the control register is never
/// written, so exception flags that are raised while the object lives stay raised.
class FloatEnvironment {
 public:
  FloatEnvironment();
  ~FloatEnvironment();
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

 private:
  std::uint64_t saved_;
};

}  // namespace pcl_bv
