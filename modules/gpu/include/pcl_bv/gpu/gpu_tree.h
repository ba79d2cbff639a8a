// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A search tree on a graphics card, and questions about it that are answered many at a time.
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

/// A search tree over the valid points of a cloud, built and questioned on the cloud's device. Its answers
/// are those of a PointTree of the same points, bit for bit.
///
/// The points are sorted along a Morton curve (Lauterbach et al. 2009), 16 to a packet. Each packet has a
/// box, each 16 boxes have a common box, and so on, as in a PointTree. The tree takes 22 bytes of the
/// device's memory per point, and while it is built another 12. Each part of the cloud (GpuInfo::max_binding,
/// up to 11 million points) has a tree of its own.
///
/// The device finds up to four points that can be the answer of a question, and the processor decides which
/// one it is. If there are more, for example because many points are equal, the processor answers from a
/// PointTree, which it builds at the first such question. It does so too for coordinates beyond 1e16. Such
/// questions are slow.
///
/// Questions may be asked by several threads at the same time, but not during refit().
class GpuTree {
 public:
  /// Builds the tree. A copy of `cloud` is kept. O(n): eight passes at most over keys of four bytes.
  ///
  /// Throws std::invalid_argument for points of doubles and for indices above 2^31 - 2 (PointView::index()).
  /// Throws GpuError if the device has too little memory or is lost.
  explicit GpuTree(const GpuCloud& cloud);
  ~GpuTree();
  GpuTree(GpuTree&&) noexcept;             ///< The other tree can then only be assigned to or destroyed.
  GpuTree& operator=(GpuTree&&) noexcept;  ///< As above.

  /// Moves the points: reads their new coordinates from `cloud`, which can be the same one if its memory was
  /// imported. Questions then have the answers of a new tree of that cloud. A new tree is faster if the
  /// points have moved far. O(n), two passes.
  ///
  /// Throws std::invalid_argument, and changes nothing, unless the cloud is on the same device, has float
  /// points, and has as many and of the same stride. Throws GpuError, and changes nothing, as the constructor
  /// does.
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
void nearest(const GpuTree& tree, const PointView& query_points, std::vector<Neighbor>& found,
             double max_distance = std::numeric_limits<double>::infinity(), const Execution& execution = {});

/// Sets inside[i] to 1 if PointTree::any_inside() holds for sphere i, else to 0. Throws GpuError as above.
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
