// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "pcl_bv/parallel/policy.h"
#include "pcl_bv/points/isa.h"

namespace [[gnu::visibility("default")]] pcl_bv {

struct Supports;

/// Where and how a fit runs. No choice here changes a single bit of the result.
struct Execution {
  ParallelPolicy parallel = Serial{};
  UsableIsa isa = Isa::automatic;  ///< Looked up where an Execution is made, not where it is copied.

  /// If not null, what find_supports() gave for these very points, which most fits begin with: they then need
  /// a pass less where it holds what they ask for. share_supports() (methods.h) decides for several methods.
  /// A fit of a view of other places (same_places() in point_view.h) throws std::invalid_argument.
  const Supports* supports = nullptr;
};

}  // namespace pcl_bv
