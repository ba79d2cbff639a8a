// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "pcl_bv/parallel/policy.h"
#include "pcl_bv/points/isa.h"

namespace [[gnu::visibility("default")]] pcl_bv {

struct Supports;

/// Threads, instruction set and known supports for a fit. None of them changes a bit of the result.
struct Execution {
  ParallelPolicy parallel = Serial{};  ///< Threads that the fit may use.
  UsableIsa isa = Isa::automatic;      ///< `automatic` is resolved when an Execution is made, not copied.

  /// The result of find_supports() for the points of the fit, or null. Most fits begin with supports. Such a
  /// fit saves a pass over the points if the directions and the detail that it needs are in `supports`.
  /// share_supports() (methods.h) sets this member for several methods. A fit throws std::invalid_argument if
  /// its view is not the one for which the supports were found (same_memory() in point_view.h).
  const Supports* supports = nullptr;
};

}  // namespace pcl_bv
