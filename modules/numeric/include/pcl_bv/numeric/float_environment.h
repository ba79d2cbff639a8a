// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Flush-to-zero set by a host program would turn coordinates of 1e-41 into 0: every public entry, every verb
// of a volume and every worker thread runs under this guard.
#pragma once

#include <cstdint>

namespace [[gnu::visibility("default")]] pcl_bv {

/// While it lives, this thread computes in the IEEE default environment: denormals kept (no FTZ, no DAZ),
/// rounding to nearest, no traps. The previous environment returns at destruction. Where it is the default
/// already, nothing is written, and flags of exceptions that are raised meanwhile stay raised.
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
