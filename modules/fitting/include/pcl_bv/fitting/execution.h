// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "pcl_bv/parallel/policy.h"
#include "pcl_bv/points/isa.h"

namespace [[gnu::visibility("default")]] pcl_bv {

struct Supports;

/// How a fit runs: threads, instruction set and supports that are already known. No choice here changes a
/// single bit of the result.
struct Execution {
  ParallelPolicy parallel = Serial{};  ///< Threads that the fit may use.
  UsableIsa isa = Isa::automatic;      ///< `automatic` is resolved when an Execution is made, not copied.

  /// If not null: the result of find_supports() for exactly these points. Most fits begin with supports; they
  /// save a pass over the points if the directions and the detail that they need are in here.
  /// share_supports() (methods.h) prepares this for several methods. A fit throws std::invalid_argument if
  /// its view is not the one that was searched (same_memory() in point_view.h).
  const Supports* supports = nullptr;
};

}  // namespace pcl_bv
