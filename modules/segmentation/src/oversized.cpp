// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "oversized.h"

#include <utility>

#include "collect.h"
#include "pcl_bv/points/select_points.h"

namespace pcl_bv::detail {
namespace {

constexpr int halvings = 3;

void clear(Clusters& clusters) {
  clusters.indices.clear();
  clusters.offsets.assign(1, 0);
  clusters.small_points = clusters.large_points = clusters.noise_points = 0;
}

bool any_above(const Clusters& clusters, std::size_t size) {
  for (std::size_t i = 0; i < clusters.size(); ++i)
    if (clusters.list_size(i) > size) return true;
  return false;
}

}  // namespace

void split_oversized(const PointView& points, const ClusterOptions& options, const ClusterPoints& cluster,
                     Clusters& clusters, SplitScratch& scratch) {
  if (!any_above(clusters, options.max_size)) return;
  ClusterOptions finer = options;
  scratch.current = clusters;
  for (int round = 0; round < halvings && any_above(scratch.current, options.max_size); ++round) {
    finer.tolerance /= 2;
    finer.tolerance_per_metre /= 2;
    clear(scratch.next);
    for (std::size_t i = 0; i < scratch.current.size(); ++i) {
      if (scratch.current.list_size(i) <= options.max_size) {
        append(scratch.current, i, scratch.next);
        continue;
      }
      cluster(select_points(points, scratch.current.list(i), scratch.current.list_size(i)), finer,
              scratch.next);
    }
    clusters.small_points += scratch.next.small_points;
    clusters.noise_points += scratch.next.noise_points;
    std::swap(scratch.current, scratch.next);
  }
  write_sorted(scratch.current, options.max_size, scratch.order, clusters);
}

}  // namespace pcl_bv::detail
