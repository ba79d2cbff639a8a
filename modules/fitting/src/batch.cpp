// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Big clouds are chunked, small ones handed out.

#include "pcl_bv/fitting/batch.h"

#include <algorithm>
#include <numeric>

#include "pcl_bv/parallel/for_each_chunk.h"
#include "schedule.h"

namespace pcl_bv {
namespace {

// A fit's serial time, roughly: what 300-point clusters cost (0.2 us for a box, 4 us for a sphere) lies on
// both sides.
constexpr double kSecondsPerPoint = 5e-9;
constexpr std::size_t kManyPoints = 200'000;

}  // namespace

void for_each_view(const std::vector<PointView>& views, const Execution& execution,
                   const std::function<void(std::size_t, const Execution&)>& fit) {
  std::vector<std::size_t> order(views.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return views[a].count > views[b].count; });
  const auto small =
      std::find_if(order.begin(), order.end(), [&](std::size_t i) { return views[i].count < kManyPoints; });
  std::for_each(order.begin(), small, [&](std::size_t i) { fit(i, execution); });

  const auto points = std::accumulate(small, order.end(), std::size_t{0},
                                      [&](std::size_t sum, std::size_t i) { return sum + views[i].count; });
  const Execution serial{Serial{}, execution.isa};
  const ParallelPolicy policy =
      worthwhile(execution.parallel, kSecondsPerPoint * static_cast<double>(points));
  for_each_chunk(policy, static_cast<std::size_t>(order.end() - small),
                 [&](std::size_t n) { fit(small[static_cast<std::ptrdiff_t>(n)], serial); });
}

}  // namespace pcl_bv
