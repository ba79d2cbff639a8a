// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What reading partial results does not call.
#include <cstdlib>

#include "pcl_bv/fitting/partial.h"
#include "pcl_bv/fitting/partial_clouds.h"
#include "pcl_bv/kernels/moments.h"

namespace pcl_bv {

void Partial::merge(const Partial&) {
  std::abort();
}

Partial detail::join_clouds(const std::vector<Partial>&) {
  std::abort();
}

detail::Moments detail::block_moments(UsableIsa, const PointView&) {
  std::abort();
}

}  // namespace pcl_bv
