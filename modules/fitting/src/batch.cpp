// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/batch.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>

#include "pcl_bv/parallel/for_each_chunk.h"
#include "schedule.h"

namespace pcl_bv {
namespace {

constexpr std::size_t kManyPoints = 200'000;

// Returns how long the call takes. The time must be measured because it depends on the method. For 300
// points, a box takes 0.2 us and a capsule about a thousand times as long.
template <typename Call>
double seconds(const Call& call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

void for_each_view(const std::vector<PointView>& views, const Execution& execution,
                   const std::function<void(std::size_t, const Execution&)>& fit) {
  const auto larger = [&](std::size_t a, std::size_t b) {
    return std::make_pair(views[b].count, a) < std::make_pair(views[a].count, b);
  };
  // Clusters are usually in descending order of size. Then nothing is sorted or allocated.
  std::vector<std::size_t> order;
  const auto by_count = [](const PointView& a, const PointView& b) { return a.count > b.count; };
  if (!std::is_sorted(views.begin(), views.end(), by_count)) {
    order.resize(views.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), larger);
  }
  const auto nth = [&](std::size_t n) { return order.empty() ? n : order[n]; };

  std::size_t small = 0;
  for (; small < views.size() && views[nth(small)].count >= kManyPoints; ++small)
    fit(nth(small), {execution.parallel, execution.isa});
  if (small == views.size()) return;
  // The time of one view of middle size predicts the time of the others. Only the number of threads depends
  // on this prediction. The largest view would predict better, but all other threads wait while it is fitted.
  const Execution serial{Serial{}, execution.isa};
  const std::size_t probe =
      thread_count(execution.parallel) == 1 ? small : small + (views.size() - small) / 2;
  const double took = seconds([&] { fit(nth(probe), serial); });
  const auto weight = [&](std::size_t n) { return static_cast<double>(views[nth(n)].count + 1); };
  double points = -weight(probe);
  for (std::size_t n = small; n < views.size(); ++n)
    points += weight(n);
  const ParallelPolicy policy = worthwhile(execution.parallel, took / weight(probe) * points);
  for_each_chunk(policy, views.size() - small - 1, [&](std::size_t i) {
    const std::size_t n = small + i;
    fit(nth(n < probe ? n : n + 1), serial);
  });
}

}  // namespace pcl_bv
