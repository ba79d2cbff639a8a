// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Search trees on a graphics card, for many queries at a time.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "pcl_bv/gpu/gpu_cloud.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/trees/point_tree.h"
#include "pcl_bv/volumes/sphere.h"

namespace [[gnu::visibility("default")]] pcl_bv {

namespace detail {
class DeviceTree;
}

/// A search tree over the valid points of a cloud, built and searched on the cloud's device. The results of
/// all queries have the same bits as those of a PointTree of the same points.
///
/// The points are sorted along a Morton curve (Lauterbach et al. 2009), 16 to a packet. Each packet has a
/// box, each 16 boxes have a common box, and so on, as in a PointTree. The tree takes 22 bytes of device
/// memory per point. The build needs another 12 bytes per point. A cloud that is larger than one buffer
/// (GpuInfo::max_binding, 11 million points of 12 bytes) has a tree for each buffer.
///
/// The device finds up to four points that can be the result of a query, and the processor decides among
/// them. If there are more, the processor runs the query on a PointTree. It builds this tree at the first
/// such query after each build or refit(), from GpuCloud::points(), and keeps it. This takes 30 ns and 52
/// bytes per point. Queries are left to the processor if many points have nearly the same distance
/// (differences below 2^-17 of the coordinates relative to the centre of the cloud), if a coordinate or a
/// radius is above 1e16, and if the length of a direction is below 2^-900 or above 2^900.
///
/// With HostPoints::keep the uploaded view must outlive the tree and not change. Imported points must not
/// change from the build or refit() to the last query. Queries may run in several threads at the same time,
/// but not during refit().
class GpuTree {
 public:
  /// Builds the tree, and keeps a copy of `cloud`, which refers to the same points. O(n).
  ///
  /// Throws std::invalid_argument for points of doubles and for indices above 2^31 - 2 (PointView::index()).
  /// Throws GpuError if the device has too little memory or is lost.
  explicit GpuTree(const GpuCloud& cloud);
  ~GpuTree();
  GpuTree(GpuTree&&) noexcept;             ///< The other tree can then only be assigned to or destroyed.
  GpuTree& operator=(GpuTree&&) noexcept;  ///< As above.

  /// Moves the points: reads their new coordinates from `cloud`. This can be the same cloud, if its memory
  /// was imported. The results of queries are then those of a new tree of `cloud`. A new tree is faster if
  /// points have moved relative to one another. O(n).
  ///
  /// Throws std::invalid_argument, and changes nothing, as the constructor does, and unless the cloud is on
  /// the same device, has the same number of points and the same stride in the device's memory (12 bytes if
  /// it was uploaded). Throws GpuError as the constructor does. The results are then undefined until a
  /// refit() succeeds.
  void refit(const GpuCloud& cloud);

  std::size_t size() const;     ///< Number of valid points.
  std::size_t dropped() const;  ///< Number of points that are not valid.
  bool empty() const { return size() == 0; }

  const detail::DeviceTree& on_device() const { return *tree_; }  ///< Private.

 private:
  std::unique_ptr<detail::DeviceTree> tree_;
};

/// Sets found[i] to PointTree::nearest() of the i-th query point, or to index -1 and squared distance
/// infinity if there is none. Throws std::invalid_argument if the query points are not in memory, or if
/// max_distance is negative or NaN. Throws GpuError if the device has too little memory or is lost.
/// Exceptions of the source of GpuCloud::points() are passed on. The same holds for the other queries.
void nearest(const GpuTree& tree, const PointView& query_points, std::vector<Neighbor>& found,
             double max_distance = std::numeric_limits<double>::infinity(), const Execution& execution = {});

/// Sets inside[i] to 1 if PointTree::any_inside() holds for sphere i, else to 0.
void any_inside(const GpuTree& tree, const std::vector<Sphere>& spheres, std::vector<std::uint8_t>& inside,
                const Execution& execution = {});

/// A sphere whose centre moves along `origin + t * direction`, t >= 0.
struct MovingSphere {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
  double radius;
};

/// Sets found[i] to PointTree::first_hit() of sphere i. Throws std::invalid_argument unless all radii are
/// from 0 to 1e100. Throws GpuError as above.
void first_hit(const GpuTree& tree, const std::vector<MovingSphere>& spheres,
               std::vector<std::optional<PointHit>>& found, const Execution& execution = {});

}  // namespace pcl_bv
