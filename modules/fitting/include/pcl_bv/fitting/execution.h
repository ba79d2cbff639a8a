// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How a fit runs, as one argument.
#pragma once

#include "pcl_bv/kernels/isa.h"
#include "pcl_bv/parallel/policy.h"

namespace pcl_bv {

/// Where and how a fit runs. No choice here changes a single bit of the result.
struct Execution {
  ParallelPolicy parallel = Serial{};
  Isa isa = Isa::automatic;
};

}  // namespace pcl_bv
