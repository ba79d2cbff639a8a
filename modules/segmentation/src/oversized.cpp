// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "oversized.h"

#include <utility>

#include "collect.h"

namespace pcl_bv {
namespace {

constexpr int halvings = 3;

void clear(Clusters& clusters) {
  clusters.indices.clear();
  clusters.offsets.assign(1, 0);
  clusters.small_points = clusters.large_points = clusters.noise_points = 0;
}

bool any_above(const Clusters& clusters, std::size_t size) {
  for (std::size_t i = 0; i < clusters.size(); ++i)
    if (clusters.cluster_size(i) > size) return true;
  return false;
}

}  // namespace

void split_oversized(const PointView& points, const ClusterSettings& settings, const ClusterPoints& cluster,
                     Clusters& clusters, SplitScratch& scratch) {
  if (!any_above(clusters, settings.max_size)) return;
  ClusterSettings finer = settings;
  scratch.current = clusters;
  for (int round = 0; round < halvings && any_above(scratch.current, settings.max_size); ++round) {
    finer.tolerance /= 2;
    finer.tolerance_per_metre /= 2;
    clear(scratch.next);
    for (std::size_t i = 0; i < scratch.current.size(); ++i) {
      if (scratch.current.cluster_size(i) <= settings.max_size) {
        append(scratch.current, i, scratch.next);
        continue;
      }
      PointView part = points;
      part.indices = scratch.current.cluster(i);
      part.count = scratch.current.cluster_size(i);
      cluster(part, finer, scratch.next);
    }
    clusters.small_points += scratch.next.small_points;
    clusters.noise_points += scratch.next.noise_points;
    std::swap(scratch.current, scratch.next);
  }
  write_sorted(scratch.current, settings.max_size, scratch.order, clusters);
}

}  // namespace pcl_bv
