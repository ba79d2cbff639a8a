// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cluster_refiner.h"

#include <algorithm>

#include "density_cell.h"
#include "pcl_bv/points/select_points.h"

namespace pcl_bv::detail {
namespace {

Eigen::Vector3d point_at(const PointView& view, std::size_t i) {
  const Coordinates c = load_point(view, i);
  return {c.x, c.y, c.z};
}

// Options for clusters of this class.
RefineOptions options_of(const RefineOptions& all, std::int64_t class_value) {
  RefineOptions options = all;
  for (const ClassOptions& own : *all.classes)
    if (own.value == class_value) options.min_size = own.clusters.min_size;
  return options;
}

}  // namespace

void ClusterRefiner::place(const PointView& cluster, const Pose& pose) {
  points_.clear();
  box_.setEmpty();
  for (std::size_t i = 0; i < cluster.count; ++i) {
    points_.push_back(pose * point_at(cluster, i));
    box_.extend(points_.back());
  }
}

// Adds the end of indices_, from `begin` on, as a piece.
void ClusterRefiner::add_piece(const PointView& cloud, const RefineOptions& options, std::size_t begin,
                               std::size_t cluster, bool is_part) {
  Piece piece{begin, indices_.size() - begin, cluster, is_part ? Refinement::cut : Refinement::none, {}};
  if (options.known != nullptr) {
    place(select_points(cloud, indices_.data() + begin, piece.size), options.pose);
    piece.box = box_;
  }
  pieces_.push_back(piece);
}

// Cuts the points of `list` at necks, and adds the pieces. The indices of each piece stay ascending.
void ClusterRefiner::cut_at_neck(const PointView& cloud, const RefineOptions& options,
                                 const std::int32_t* list, std::size_t size, std::size_t cluster,
                                 bool is_part) {
  const PointView view = select_points(cloud, list, size);
  const std::size_t parts = std::max<std::size_t>(
      1, neck_cut_.find(view, options.up, options.sensor, options.min_size, neck_part_of_));
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t begin = indices_.size();
    for (std::size_t i = 0; i < size; ++i)
      if (parts == 1 || neck_part_of_[i] == part) indices_.push_back(list[i]);
    add_piece(cloud, options, begin, cluster, is_part || parts > 1);
  }
}

void ClusterRefiner::cut(const PointView& cloud, const RefineOptions& options, const Clusters& clusters,
                         std::size_t cluster) {
  const std::int32_t* const list = clusters.list(cluster);
  const std::size_t size = clusters.list_size(cluster);
  std::size_t parts = 1;
  if (options.known != nullptr) {
    const PointView view = select_points(cloud, list, size);
    place(view, options.pose);
    const double cell = density_cell((point_at(view, 0) - options.sensor).norm());
    parts = track_cut_.find(points_, box_, *options.known, cell, options.min_size, part_of_);
  }
  if (parts < 2) {
    cut_at_neck(cloud, options, list, size, cluster, false);
    return;
  }
  for (std::size_t part = 0; part < parts; ++part) {
    part_.clear();
    for (std::size_t i = 0; i < size; ++i)
      if (part_of_[i] == part) part_.push_back(list[i]);
    cut_at_neck(cloud, options, part_.data(), part_.size(), cluster, true);
  }
}

// Moves the indices of joined pieces to the end of indices_.
void ClusterRefiner::join() {
  members_.clear();
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (whole_of_[i] == PartJoin::none) continue;
    members_.emplace_back(whole_of_[i], whole_of_[i]);
    members_.emplace_back(whole_of_[i], i);
  }
  std::sort(members_.begin(), members_.end());
  members_.erase(std::unique(members_.begin(), members_.end()), members_.end());
  for (std::size_t m = 0; m < members_.size();) {
    const std::size_t whole = members_[m].first, begin = indices_.size();
    for (; m < members_.size() && members_[m].first == whole; ++m) {
      Piece& part = pieces_[members_[m].second];
      for (std::size_t i = 0; i < part.size; ++i)
        indices_.push_back(indices_[part.begin + i]);
      part.size = 0;
    }
    std::sort(indices_.begin() + static_cast<std::ptrdiff_t>(begin), indices_.end());
    pieces_[whole].begin = begin;
    pieces_[whole].size = indices_.size() - begin;
    pieces_[whole].refinement = Refinement::joined;
  }
  std::erase_if(pieces_, [](const Piece& piece) { return piece.size == 0; });
}

void ClusterRefiner::replace(Clusters& clusters, std::vector<std::int64_t>& class_of,
                             std::vector<Refinement>& refinements) {
  std::sort(pieces_.begin(), pieces_.end(), [&](const Piece& a, const Piece& b) {
    return a.size != b.size ? a.size > b.size : indices_[a.begin] < indices_[b.begin];
  });
  clusters.indices.clear();
  clusters.offsets.assign(1, 0);
  classes_.swap(class_of);
  class_of.clear();
  refinements.clear();
  for (const Piece& piece : pieces_) {
    const auto begin = indices_.begin() + static_cast<std::ptrdiff_t>(piece.begin);
    clusters.indices.insert(clusters.indices.end(), begin, begin + static_cast<std::ptrdiff_t>(piece.size));
    clusters.offsets.push_back(clusters.indices.size());
    if (!classes_.empty()) class_of.push_back(classes_[piece.cluster]);
    refinements.push_back(piece.refinement);
  }
}

void ClusterRefiner::refine(const PointView& cloud, const RefineOptions& options, Clusters& clusters,
                            std::vector<std::int64_t>& class_of, std::vector<Refinement>& refinements,
                            Counts& counts) {
  indices_.clear();
  pieces_.clear();
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const std::size_t before = pieces_.size();
    const bool own = options.classes != nullptr && !class_of.empty();
    cut(cloud, own ? options_of(options, class_of[i]) : options, clusters, i);
    counts.cut += pieces_.size() > before + 1;
  }
  if (options.known != nullptr) {
    counts.joined = part_join_.find(pieces_, *options.known, class_of, whole_of_);
    if (counts.joined > 0) join();
  }
  if (counts.cut + counts.joined > 0) {
    replace(clusters, class_of, refinements);
  } else {
    refinements.assign(clusters.size(), Refinement::none);
  }
}

}  // namespace pcl_bv::detail
