// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Built with -O2 -fno-tree-vectorize.

#include "plain_dop26.h"

namespace pcl_bv::bench {

PlainDop26 naive_dop26(const float* xyzw, std::size_t points) {
  PlainDop26 out;
  out.low.fill(3.402823466e38F);
  out.high.fill(-3.402823466e38F);
  for (std::size_t i = 0; i < points; ++i) {
    const float x = xyzw[4 * i], y = xyzw[4 * i + 1], z = xyzw[4 * i + 2];
    const float projections[kMaxDirections] = {
        x, y, z, x + y + z, x + y - z, x - y + z, x - y - z, x + y, x - y, x + z, x - z, y + z, y - z};
    for (std::size_t k = 0; k < kMaxDirections; ++k) {
      if (projections[k] < out.low[k]) out.low[k] = projections[k];
      if (projections[k] > out.high[k]) out.high[k] = projections[k];
    }
  }
  return out;
}

}  // namespace pcl_bv::bench
