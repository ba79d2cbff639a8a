// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Decides how many threads a pass uses. A small pass is fastest in one thread, because starting threads costs
// microseconds, or tens of microseconds if they sleep.
#pragma once

#include <algorithm>

#include "pcl_bv/parallel/execution.h"

namespace pcl_bv::detail {

/// Returns the policy with at most one thread per 100 us of work. If one thread needs less than 200 us for
/// the work, returns Serial.
inline ParallelPolicy worthwhile(const ParallelPolicy& policy, double serial_seconds) {
  if (serial_seconds < 200e-6) return Serial{};
  return limit_threads(policy, static_cast<unsigned>(std::min(serial_seconds / 100e-6, 1024.0)));
}

/// Kinds of work on one point, plane or vertex.
enum class Work {
  box,
  cube_support,
  custom_support,
  distance,
  half_spaces,
  outline,
  rank,
  verify,
  hull_plane,
  silhouette  ///< One vertex of a hull, in the silhouette and in the rotating calipers.
};

/// Returns the time in nanoseconds that one thread needs per point. For supports it is the time per point and
/// direction, for hull_plane the time per plane, for silhouette the time per vertex. Only the order of
/// magnitude matters. Measured on a Zen 5 with the points in the third-level cache.
constexpr double nanoseconds(Work work, Isa isa) {
  struct Cost {
    double scalar, bits128, avx2, avx512;
  };
  constexpr Cost costs[] = {{1.3, 0.27, 0.17, 0.17},
                            {0.5, 0.12, 0.058, 0.026},
                            {0.9, 0.17, 0.08, 0.05},
                            {1.2, 0.4, 0.25, 0.15},
                            {20, 3, 3, 3},
                            {5, 5, 5, 5},  // 1 if all points are inside the first polygon, 50 if none is
                            {3, 3, 3, 3},
                            {50, 50, 50, 50},
                            {5e3, 5e3, 5e3, 5e3},
                            {15, 15, 15, 15}};
  const Cost& cost = costs[static_cast<std::size_t>(work)];
  return isa == Isa::scalar   ? cost.scalar
         : isa == Isa::avx512 ? cost.avx512
         : isa == Isa::avx2   ? cost.avx2
                              : cost.bits128;
}

/// Returns the policy for a pass that takes nanoseconds() `count` times. Usually `count` is the number of
/// points. For supports it is the number of points times the number of directions.
inline ParallelPolicy worthwhile(const Execution& execution, Work work, std::size_t count) {
  return worthwhile(execution.parallel, 1e-9 * nanoseconds(work, execution.isa) * static_cast<double>(count));
}

}  // namespace pcl_bv::detail
