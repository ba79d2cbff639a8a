// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Built with -O2 -fno-tree-vectorize.

#include "plain_dop.h"

namespace pcl_bv::bench {
using namespace detail;

template <std::size_t directions>
PlainDop naive_dop(const float* xyzw, std::size_t points) {
  PlainDop out;
  out.low.fill(3.402823466e38F);
  out.high.fill(-3.402823466e38F);
  for (std::size_t i = 0; i < points; ++i) {
    const float x = xyzw[4 * i], y = xyzw[4 * i + 1], z = xyzw[4 * i + 2];
    const float projections[kMaxDirections] = {
        x, y, z, x + y + z, x + y - z, x - y + z, x - y - z, x + y, x - y, x + z, x - z, y + z, y - z};
    for (std::size_t k = 0; k < directions; ++k) {
      if (projections[k] < out.low[k]) out.low[k] = projections[k];
      if (projections[k] > out.high[k]) out.high[k] = projections[k];
    }
  }
  return out;
}

template PlainDop naive_dop<3>(const float*, std::size_t);
template PlainDop naive_dop<7>(const float*, std::size_t);
template PlainDop naive_dop<13>(const float*, std::size_t);

}  // namespace pcl_bv::bench
