// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Cuts clusters that hold several objects, and joins clusters that are parts of one object.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "neck_cut.h"
#include "part_join.h"
#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/segmentation/class_clusters.h"
#include "pcl_bv/segmentation/clusters.h"
#include "track_cut.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// The frame whose clusters are refined.
struct RefineOptions {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();     ///< Of length 1.
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();  ///< Position of the sensor in the frame of the points.
  /// Sensors of a merged cloud. The nearest one replaces `sensor`. May be null.
  const std::vector<SensorPart>* sensors = nullptr;
  std::size_t min_size = 1;                          ///< Smallest number of points of a part.
  /// Classes whose min_size replaces that of these options. May be null.
  const std::vector<ClassOptions>* classes = nullptr;
  UsableIsa isa{};
  ParallelPolicy parallel{};
};

/// Replaces clusters by objects. Each point of a cluster is in exactly one object. The objects keep the order
/// that Clusters describes. `class_of` has the class of each cluster, or is empty.
class ClusterRefiner {
 public:
  /// Cuts groups of people and people next to other objects (NeckCut). Fills `refinements`, an entry for each
  /// cluster, and adds to `counts.cut`.
  void cut_at_necks(const PointView& cloud, const RefineOptions& options, Clusters& clusters,
                    std::vector<std::int64_t>& class_of, std::vector<Refinement>& refinements,
                    Counts& counts);

  /// Cuts tracked people off other objects (TrackCut), then joins the parts of tracked vehicles (PartJoin).
  /// `known` is what the tracker expects in this frame, sorted by the x of the centres; `pose` is the pose of
  /// the points in its frame. Changes `refinements`, and adds to `counts.cut` and `counts.joined`.
  void follow_tracks(const PointView& cloud, const RefineOptions& options, const Pose& pose,
                     const std::vector<KnownObject>& known, Clusters& clusters,
                     std::vector<std::int64_t>& class_of, std::vector<Refinement>& refinements,
                     Counts& counts);

 private:
  // Scratch memory of one lane of clusters.
  struct LaneScratch {
    NeckCut neck_cut;
    TrackCut track_cut;
    std::vector<Eigen::Vector3d> points;  // of a cluster, in the fixed frame
    std::vector<std::uint32_t> part_of;
  };

  void start(Clusters& clusters, std::vector<Refinement>& refinements);
  template <typename Cut>
  std::size_t cut_each(const Clusters& clusters, const ParallelPolicy& policy, const Cut& cut_cluster);
  std::size_t cut_by_tracks(LaneScratch& lane, const PointView& cluster, const RefineOptions& options,
                            const Pose& pose, const std::vector<KnownObject>& known, std::size_t min_size,
                            Eigen::AlignedBox3d& box) const;
  void add_parts(const Clusters& clusters, std::size_t cluster, Refinement refinement);
  void join();
  void replace(Clusters& clusters, std::vector<std::int64_t>& class_of, std::vector<Refinement>& refinements);

  std::vector<LaneScratch> lanes_;
  PartJoin part_join_;
  std::vector<std::size_t> parts_;          // number of parts of each cluster
  std::vector<Eigen::AlignedBox3d> boxes_;  // of each cluster, in the fixed frame
  std::vector<std::uint32_t> part_of_;      // of each point of clusters that are cut, as in Clusters::indices
  std::vector<std::int32_t> indices_;
  std::vector<ClusterPart> pieces_;
  std::vector<std::size_t> whole_of_;
  std::vector<std::pair<std::size_t, std::size_t>> members_;  // a joined piece and one of its parts
  std::vector<std::int64_t> classes_;
};

}  // namespace detail
}  // namespace pcl_bv
