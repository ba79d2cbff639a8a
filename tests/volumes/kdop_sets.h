// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Direction sets to test with: the built-in ones and two of a user's own.
#pragma once

#include <memory>
#include <vector>

#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv::testing {

/// The built-in sets, a tilted set without axes, and one with axes late, unequal lengths and doubled
/// directions.
inline std::vector<std::shared_ptr<const KdopSet>> kdop_sets() {
  using Directions = std::vector<Eigen::Vector3d>;
  return {KdopSet::dop6(),
          KdopSet::dop14(),
          KdopSet::dop18(),
          KdopSet::dop26(),
          std::make_shared<const KdopSet>(Directions{
              {0.3, 0.4, 0.5}, {-0.7, 0.2, 0.1}, {0.1, -0.3, 0.9}, {0.5, 0.5, -0.7}, {0.6, -0.6, 0.1}}),
          std::make_shared<const KdopSet>(
              Directions{{1, 2, 3}, {-2, -4, -6}, {100, 0, 0}, {0, 1e-3, 0}, {0, 0, 1}, {3, -1, 0.1}})};
}

}  // namespace pcl_bv::testing
