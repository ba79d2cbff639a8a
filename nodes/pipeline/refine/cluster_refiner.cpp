// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cluster_refiner.h"

#include <algorithm>

#include "pcl_bv/points/select_points.h"

namespace pcl_bv::detail {
namespace {

std::size_t min_size_of(const RefineOptions& options, std::int64_t class_value) {
  for (const ClassOptions& own : *options.classes) {
    if (own.value == class_value) return own.clusters.min_size;
  }
  return options.min_size;
}

}  // namespace

// The indices of each part stay ascending.
void ClusterRefiner::add_parts(const Clusters& clusters, std::size_t cluster, std::size_t parts) {
  const std::int32_t* const list = clusters.list(cluster);
  const std::size_t size = clusters.list_size(cluster);
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t begin = indices_.size();
    for (std::size_t i = 0; i < size; ++i)
      if (parts == 1 || part_of_[i] == part) indices_.push_back(list[i]);
    pieces_.push_back({begin, indices_.size() - begin, cluster, parts > 1});
  }
}

void ClusterRefiner::replace(Clusters& clusters, std::vector<std::int64_t>& class_of,
                             std::vector<std::uint8_t>& cut) {
  std::sort(pieces_.begin(), pieces_.end(), [&](const Piece& a, const Piece& b) {
    return a.size != b.size ? a.size > b.size : indices_[a.begin] < indices_[b.begin];
  });
  clusters.indices.clear();
  clusters.offsets.assign(1, 0);
  classes_.swap(class_of);
  class_of.clear();
  cut.clear();
  for (const Piece& piece : pieces_) {
    const auto begin = indices_.begin() + static_cast<std::ptrdiff_t>(piece.begin);
    clusters.indices.insert(clusters.indices.end(), begin, begin + static_cast<std::ptrdiff_t>(piece.size));
    clusters.offsets.push_back(clusters.indices.size());
    if (!classes_.empty()) class_of.push_back(classes_[piece.cluster]);
    cut.push_back(piece.cut ? 1 : 0);
  }
}

std::size_t ClusterRefiner::cut_at_necks(const PointView& cloud, const RefineOptions& options,
                                         Clusters& clusters, std::vector<std::int64_t>& class_of,
                                         std::vector<std::uint8_t>& cut) {
  indices_.clear();
  pieces_.clear();
  std::size_t cut_clusters = 0;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const PointView cluster = select_points(cloud, clusters.list(i), clusters.list_size(i));
    const bool own = options.classes != nullptr && !class_of.empty();
    const std::size_t min_size = own ? min_size_of(options, class_of[i]) : options.min_size;
    const std::size_t parts = neck_cut_.find(cluster, options.up, options.sensor, min_size, part_of_);
    add_parts(clusters, i, std::max<std::size_t>(parts, 1));
    cut_clusters += parts > 1;
  }
  if (cut_clusters == 0) {
    cut.assign(clusters.size(), 0);
  } else {
    replace(clusters, class_of, cut);
  }
  return cut_clusters;
}

}  // namespace pcl_bv::detail
