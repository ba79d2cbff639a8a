// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clusters of clouds that do not fit in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/segmentation/clusters.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

class ClusterShare;
class ShareError;

/// Identifies a component of a share.
struct ComponentOfShare {
  std::size_t share = 0;  ///< Number of the share among those that are merged.
  std::uint32_t number = 0;
};

/// Identifies a cluster that was visited (StoredClusterOptions::visit).
struct StoredVisit {
  std::size_t brick = 0;
  std::size_t number = 0;  ///< Among the clusters of the call.
};

struct StoredClusterOptions {
  /// Maximum number of points in memory. A single cell of the grid and the points near a brick may exceed it,
  /// and there are at most 16 384 bricks. A point takes up to 150 bytes, a double point 250.
  std::size_t points_in_memory = std::size_t{4} << 20;
  /// Where the temporary file is made; empty for the system's folder of temporary files.
  std::filesystem::path folder;
  /// If set, is called with the clusters of a brick while their points are in memory, which saves writing
  /// them to the temporary file. These are the clusters of allowed sizes that have no part in other bricks.
  /// Points are in the order of the cloud. There is at most one call for each brick. Several threads may call
  /// at the same time, each with the execution that the call may use.
  std::function<void(std::size_t brick, const std::vector<PointView>& clusters, const Execution& execution)>
      visit{};
  /// Whether visited clusters have points(), too.
  bool keep_visited = true;
  /// Whether points have labels(). Takes a temporary file of 4 bytes for each point; 8 bytes with shares, all
  /// of whose points are read.
  bool has_labels = false;
  /// With shares and labels: number of points of the cloud.
  std::uint64_t points_of_shares = 0;
  /// If set, tells which components of shares need no points(). See StoredClusters::component().
  std::function<bool(const ComponentOfShare& component)> is_known{};
  /// If set, is called with the error of each share that has points with a wrong check sum, and their number.
  /// These points are left out: see StoredClusters::is_incomplete(). If not set, the error is thrown. Not for
  /// shares with ShareRecords::gather.
  std::function<void(const ShareError& error, std::uint64_t points)> on_lost{};
};

/// The clusters of EuclideanClusterer for a cloud of any size. Their points are in a temporary file, which
/// the system deletes when the process ends, whatever the reason.
///
/// The points are distributed to boxes ("bricks") with about StoredClusterOptions::points_in_memory points
/// each. A brick also gets the points of other bricks that can affect the result for its own points: those
/// within the tolerance, or with min_points > 1 within twice the tolerance. Each brick is clustered in
/// memory. Components of neighbouring bricks are joined if they have a core point in common. So every link
/// and every core condition is decided in a brick that has all points that matter, and the result is that of
/// the whole cloud.
class StoredClusters {
 public:
  /// Finds the clusters of the valid points. Takes two passes over the points. The order of the passes does
  /// not depend on the execution, nor does the result.
  ///
  /// The temporary file takes about 30 bytes for each float point and 50 for each double point; up to twice
  /// as many if most points are near borders of bricks. Memory: a brick, 24 bytes for each cluster, and 60
  /// bytes for each cell of 16 tolerances that has points.
  ///
  /// Throws std::invalid_argument if an option is outside its range, for tolerance_per_metre > 0 and for
  /// Oversized::split. Throws std::runtime_error, with the reason, if the temporary file cannot be made or
  /// written. Exceptions of the source of the points are passed on.
  StoredClusters(const PointView& points, const ClusterOptions& options,
                 const StoredClusterOptions& store = {}, const Execution& execution = {});
  /// Finds the clusters of a cloud that consists of shares (MadeClusterShare) with the same options. The
  /// result is that of the whole cloud, whose points have the numbers of the shares. The shares must outlive
  /// this object.
  ///
  /// Reads the points near other shares, and those of clusters that are joined or not known
  /// (StoredClusterOptions::is_known). Memory: 32 bytes for each run of the shares, 60 bytes for each cell,
  /// and as above for the points near other shares.
  ///
  /// Throws as above, std::invalid_argument for shares of both float and double points, and ShareError if a
  /// share cannot be read.
  StoredClusters(const std::vector<const ClusterShare*>& shares, const ClusterOptions& options,
                 const StoredClusterOptions& store = {}, const Execution& execution = {});
  ~StoredClusters();
  StoredClusters(StoredClusters&&) noexcept;
  StoredClusters& operator=(StoredClusters&&) noexcept;

  /// Number of clusters. They are in the order of Clusters: the largest first.
  std::size_t size() const;

  /// Number of bricks.
  std::size_t brick_count() const;

  /// Number of points of a cluster.
  std::size_t point_count(std::size_t cluster) const;

  /// Number of the first point of a cluster in the cloud.
  std::size_t first_number(std::size_t cluster) const;

  /// The visit of a cluster, or nothing if it was not visited.
  std::optional<StoredVisit> visit(std::size_t cluster) const;

  /// The component of a share that has exactly the points of the cluster, or nothing.
  std::optional<ComponentOfShare> component(std::size_t cluster) const;

  /// Whether the cluster may lack points, because points of a share near it cannot be read. Clusters of lost
  /// points only do not exist.
  bool is_incomplete(std::size_t cluster) const;

  /// The points of a cluster in the order of the cloud, in memory or in the temporary file.
  class Points {
   public:
    /// Returns a view that is valid while this object and the StoredClusters live.
    const PointView& view() const { return view_; }

   private:
    friend class StoredClusters;
    std::vector<std::byte> bytes_;
    std::unique_ptr<PointSource> source_;
    PointView view_;
  };
  Points points(std::size_t cluster) const;

  static constexpr std::uint32_t kNoCluster = ~std::uint32_t{0};

  /// Returns the numbers of the clusters of points first to first + count - 1 of the cloud; kNoCluster for
  /// points without a cluster. Only with StoredClusterOptions::has_labels.
  std::vector<std::uint32_t> labels(std::size_t first, std::size_t count) const;

  /// Returns the point_check_sum() of points first to first + count - 1 of the cloud; 0 for points that no
  /// share has. Only for shares and with StoredClusterOptions::has_labels.
  std::vector<std::uint32_t> check_sums(std::size_t first, std::size_t count) const;

  /// Numbers of points without a cluster, by reason (as Counts): nonfinite, small, large and noise.
  const Counts& counts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace detail
}  // namespace pcl_bv
