// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// When threads pay: starting them costs microseconds, on an idle pool tens of them.
#pragma once

#include <algorithm>

#include "pcl_bv/parallel/policy.h"

namespace pcl_bv {

/// The policy, or Serial if the work would take a single thread less than 200 us; at most one thread per 100
/// us.
inline ParallelPolicy worthwhile(const ParallelPolicy& policy, double serial_seconds) {
  if (serial_seconds < 200e-6) return Serial{};
  return limit_threads(policy, static_cast<unsigned>(std::min(serial_seconds / 100e-6, 1024.0)));
}

}  // namespace pcl_bv
