// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>

#include "pcl_bv/points/isa.h"

namespace pcl_bv::bench {

struct TreeTruth {
  std::size_t questions = 0;
  std::size_t wrong = 0;
};

/// Asks PointTree about that many random things in clouds of 2048 points (the six of clouds.h and a street)
/// and looks at every point for the answer, which must be the same to the last bit: nearest, k nearest, near,
/// any_inside, count_inside of a box that lies askew, all_inside of a capsule, first_hit. Every fourth
/// distance is exactly that of a point.
TreeTruth count_wrong_answers(Isa isa, std::size_t questions);

}  // namespace pcl_bv::bench
