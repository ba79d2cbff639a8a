// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Built with -O3 -fno-tree-vectorize. Minima and maxima as expressions, which become minss and maxss.

#include "plain_dop.h"

namespace pcl_bv::bench {
using namespace detail;

#define PCL_BV_EACH_DIRECTION(DO) \
  DO(0, x)                        \
  DO(1, y)                        \
  DO(2, z)                        \
  DO(3, sum + z)                  \
  DO(4, sum - z)                  \
  DO(5, difference + z)           \
  DO(6, difference - z) DO(7, sum) DO(8, difference) DO(9, x + z) DO(10, x - z) DO(11, y + z) DO(12, y - z)
#define PCL_BV_DECLARE(k, projection) float low##k = 3.402823466e38F, high##k = -3.402823466e38F;
#define PCL_BV_STEP(k, projection)       \
  {                                      \
    const float p = projection;          \
    low##k = p < low##k ? p : low##k;    \
    high##k = p > high##k ? p : high##k; \
  }
#define PCL_BV_KEEP(k, projection) out.low[k] = low##k, out.high[k] = high##k;

PlainDop plain_dop26(const float* xyzw, std::size_t points) {
  PCL_BV_EACH_DIRECTION(PCL_BV_DECLARE)
  for (std::size_t i = 0; i < points; ++i) {
    const float x = xyzw[4 * i], y = xyzw[4 * i + 1], z = xyzw[4 * i + 2];
    const float sum = x + y;
    const float difference = x - y;
    PCL_BV_EACH_DIRECTION(PCL_BV_STEP)
  }
  PlainDop out;
  PCL_BV_EACH_DIRECTION(PCL_BV_KEEP)
  return out;
}

}  // namespace pcl_bv::bench
