// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cluster_refiner.h"

#include <algorithm>

#include "geometry.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/select_points.h"
#include "pipeline/track/viewpoints.h"

namespace pcl_bv::detail {
namespace {

std::size_t min_size_of(const RefineOptions& options, const std::vector<std::int64_t>& class_of,
                        std::size_t cluster) {
  if (options.classes == nullptr || class_of.empty()) return options.min_size;
  for (const ClassOptions& own : *options.classes)
    if (own.value == class_of[cluster]) return own.clusters.min_size;
  return options.min_size;
}

Eigen::Vector3d sensor_near(const RefineOptions& options, const PointView& cluster) {
  if (options.sensors == nullptr || cluster.empty()) return options.sensor;
  return nearest_sensor(*options.sensors, point_at(cluster, 0), options.sensor);
}

}  // namespace

// Reserves more than this frame needs: in a replay, other clusters are cut and joined.
void ClusterRefiner::start(Clusters& clusters, std::vector<Refinement>& refinements) {
  indices_.clear();
  pieces_.clear();
  indices_.reserve(2 * clusters.indices.size());
  pieces_.reserve(2 * clusters.size());
  members_.reserve(2 * clusters.size());
  classes_.reserve(2 * clusters.size());
  parts_.reserve(2 * clusters.size());
  boxes_.reserve(2 * clusters.size());
  part_of_.reserve(2 * clusters.indices.size());
  clusters.offsets.reserve(2 * clusters.offsets.size());
  refinements.reserve(2 * clusters.size());
}

// Sets parts_ to cut_cluster(i, scratch) of each cluster i, and part_of_ to the parts of clusters that are
// cut. Lane l takes the clusters l, l + lanes, ..., so each lane has large and small clusters. A lane's
// memory depends only on the clusters and the number of lanes, so a second pass allocates nothing. Returns
// the number of clusters that are cut.
template <typename Cut>
std::size_t ClusterRefiner::cut_each(const Clusters& clusters, const ParallelPolicy& policy,
                                     const Cut& cut_cluster) {
  const std::size_t lanes = thread_count(policy);
  if (lanes_.size() < lanes) lanes_.resize(lanes);
  parts_.assign(clusters.size(), 1);
  part_of_.resize(clusters.indices.size());
  for_each_chunk(policy, lanes, [&](std::size_t l) {
    LaneScratch& lane = lanes_[l];
    for (std::size_t i = l; i < clusters.size(); i += lanes) {
      parts_[i] = cut_cluster(i, lane);
      if (parts_[i] > 1)
        std::copy_n(lane.part_of.begin(), clusters.list_size(i),
                    part_of_.begin() + static_cast<std::ptrdiff_t>(clusters.offsets[i]));
    }
  });
  return static_cast<std::size_t>(
      std::count_if(parts_.begin(), parts_.end(), [](std::size_t parts) { return parts > 1; }));
}

// Adds the parts of a cluster, or the whole cluster. The indices of each part stay ascending.
void ClusterRefiner::add_parts(const Clusters& clusters, std::size_t cluster, Refinement refinement) {
  const std::int32_t* const list = clusters.list(cluster);
  const std::size_t size = clusters.list_size(cluster), parts = parts_[cluster];
  const std::uint32_t* const part_of = part_of_.data() + clusters.offsets[cluster];
  if (parts > 1) refinement = Refinement::cut;
  for (std::size_t part = 0; part < std::max<std::size_t>(parts, 1); ++part) {
    const std::size_t begin = indices_.size();
    for (std::size_t i = 0; i < size; ++i)
      if (parts < 2 || part_of[i] == part) indices_.push_back(list[i]);
    pieces_.push_back({begin, indices_.size() - begin, cluster, refinement, {}});
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
      ClusterPart& part = pieces_[members_[m].second];
      for (std::size_t i = 0; i < part.size; ++i)
        indices_.push_back(indices_[part.begin + i]);
      part.size = 0;
    }
    std::sort(indices_.begin() + static_cast<std::ptrdiff_t>(begin), indices_.end());
    pieces_[whole].begin = begin;
    pieces_[whole].size = indices_.size() - begin;
    pieces_[whole].refinement = Refinement::joined;
  }
  std::erase_if(pieces_, [](const ClusterPart& piece) { return piece.size == 0; });
}

void ClusterRefiner::replace(Clusters& clusters, std::vector<std::int64_t>& class_of,
                             std::vector<Refinement>& refinements) {
  std::sort(pieces_.begin(), pieces_.end(), [&](const ClusterPart& a, const ClusterPart& b) {
    return a.size != b.size ? a.size > b.size : indices_[a.begin] < indices_[b.begin];
  });
  clusters.indices.clear();
  clusters.offsets.assign(1, 0);
  classes_ = class_of;
  class_of.clear();
  refinements.clear();
  for (const ClusterPart& piece : pieces_) {
    const auto begin = indices_.begin() + static_cast<std::ptrdiff_t>(piece.begin);
    clusters.indices.insert(clusters.indices.end(), begin, begin + static_cast<std::ptrdiff_t>(piece.size));
    clusters.offsets.push_back(clusters.indices.size());
    if (!classes_.empty()) class_of.push_back(classes_[piece.cluster]);
    refinements.push_back(piece.refinement);
  }
}

void ClusterRefiner::cut_at_necks(const PointView& cloud, const RefineOptions& options, Clusters& clusters,
                                  std::vector<std::int64_t>& class_of, std::vector<Refinement>& refinements,
                                  Counts& counts) {
  start(clusters, refinements);
  const std::size_t cut_count = cut_each(clusters, options.parallel, [&](std::size_t i, LaneScratch& lane) {
    const PointView view = select_points(cloud, clusters.list(i), clusters.list_size(i));
    return lane.neck_cut.find(options.isa, view, options.up, sensor_near(options, view),
                              min_size_of(options, class_of, i), lane.part_of);
  });
  counts.cut += cut_count;
  if (cut_count == 0) {
    refinements.assign(clusters.size(), Refinement::none);
    return;
  }
  for (std::size_t i = 0; i < clusters.size(); ++i)
    add_parts(clusters, i, Refinement::none);
  replace(clusters, class_of, refinements);
}

// Sets `box` to that of the cluster in the fixed frame. Moves the points there only if a person is expected.
std::size_t ClusterRefiner::cut_by_tracks(LaneScratch& lane, const PointView& cluster,
                                          const RefineOptions& options, const Pose& pose,
                                          const std::vector<KnownObject>& known, std::size_t min_size,
                                          Eigen::AlignedBox3d& box) const {
  const Eigen::Vector3d first = point_at(cluster, 0);
  const double cell = density_cell((first - sensor_near(options, cluster)).norm());
  box = box_along(options.isa, cluster, pose.linear());
  box.translate(pose * first);
  lane.track_cut.reserve(cluster.count, box, cell);
  lane.points.reserve(cluster.count);
  lane.part_of.reserve(cluster.count);
  if (!lane.track_cut.expects(box, known)) return 1;
  lane.points.clear();
  for (std::size_t i = 0; i < cluster.count; ++i)
    lane.points.push_back(pose * point_at(cluster, i));
  return lane.track_cut.find(lane.points, box, known, cell, min_size, lane.part_of);
}

void ClusterRefiner::follow_tracks(const PointView& cloud, const RefineOptions& options, const Pose& pose,
                                   const std::vector<KnownObject>& known, Clusters& clusters,
                                   std::vector<std::int64_t>& class_of, std::vector<Refinement>& refinements,
                                   Counts& counts) {
  start(clusters, refinements);
  boxes_.resize(clusters.size());
  const std::size_t cut_count = cut_each(clusters, options.parallel, [&](std::size_t i, LaneScratch& lane) {
    return cut_by_tracks(lane, select_points(cloud, clusters.list(i), clusters.list_size(i)), options, pose,
                         known, min_size_of(options, class_of, i), boxes_[i]);
  });
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    add_parts(clusters, i, refinements[i]);
    pieces_.back().box = boxes_[i];
  }
  const std::size_t joined = part_join_.find(pieces_, known, class_of, whole_of_);
  if (joined > 0) join();
  counts.cut += cut_count;
  counts.joined += joined;
  if (cut_count + joined > 0) replace(clusters, class_of, refinements);
}

}  // namespace pcl_bv::detail
