// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A search tree over volumes. It finds the volumes that hold a point, are hit by a ray or are near another
// volume.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A volume of a tree and the part of a ray inside the volume.
struct VolumeHit {
  /// Index of the volume.
  std::int32_t index;
  RayInterval interval;
};

/// A volume of a tree and its distance from a query point.
struct VolumeDistance {
  /// Index of the volume.
  std::int32_t index;
  double distance;
};

/// A ray, i.e. all points `origin + t * direction` with t >= 0.
struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;  ///< Has any length; t is in multiples of the length.
};

/// A search tree over volumes of any types.
///
/// Volumes are identified by their index in the list that the tree was built from. Frame and unit are those
/// of the volumes. Every query gives the same result as calling the member functions of all volumes, one
/// volume after another. The boxes only serve to skip volumes that cannot change the result. Output lists are
/// replaced and are in ascending order of index. Empty volumes are never found.
///
/// The volumes are in the order of a balanced k-d tree of their centres. Each 16 volumes have a common box,
/// each 16 boxes have a common box, and so on. A Kdop or Hull has a box only if it has a plane perpendicular
/// to the axis for each of the six sides of the box. A Kdop or Hull without a box is tested in every query.
/// Ellipsoids with a radius more than 2^20 times another are tested for every ray.
///
/// Const member functions may be called from several threads at the same time. Copies are independent.
class VolumeTree {
 public:
  /// A tree without volumes.
  VolumeTree();

  /// Builds the tree. O(n log n). Takes 0.2 us per Sphere and 2.5 us per Obb. An Obb takes longer because
  /// Obb::aabb() is exact. The tree is the same for every Execution. Throws std::invalid_argument for more
  /// than 2^31 - 1 volumes.
  explicit VolumeTree(std::vector<AnyVolume> volumes, const Execution& execution = {});

  /// Replaces each volume by the volume of the same index, e.g. after the volumes have moved. O(n).
  ///
  /// Queries give the same results as on a new tree. A new tree is faster to query if the volumes have moved
  /// far. Throws std::invalid_argument, and changes nothing, if the number of volumes differs.
  void refit(std::vector<AnyVolume> volumes, const Execution& execution = {});

  std::size_t size() const;  ///< Number of volumes, including empty ones.
  /// Returns the volumes in the order of their indices.
  const std::vector<AnyVolume>& volumes() const;

  /// Returns whether contains() holds for any volume.
  bool any_containing(const Eigen::Vector3d& point) const;
  /// Lists the volumes for which contains() holds.
  void all_containing(const Eigen::Vector3d& point, std::vector<std::int32_t>& indices) const;

  /// Returns the volume that the ray `origin + t * direction`, t >= 0, enters first. Among the volumes for
  /// which intersect() gives an interval, this is the one with the smallest `enter`, and among equals the one
  /// with the smallest index.
  std::optional<VolumeHit> first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Lists all volumes that the ray hits.
  void all_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
               std::vector<VolumeHit>& hits) const;

  /// Lists the volumes whose aabb() overlaps the box.
  void all_with_box_overlapping(const Aabb& box, std::vector<std::int32_t>& indices) const;

  /// Lists the volumes that overlap `volume`, as overlaps() of pair_queries.h decides. Builds a ConvexBody of
  /// each volume whose box overlaps the box of `volume`.
  void all_overlapping(const AnyVolume& volume, std::vector<std::int32_t>& indices) const;

  /// Returns the volume nearest to the point, if its distance() is at most `max_distance`. Among equally near
  /// volumes it is the one with the smallest index. Returns nothing for a point with a NaN. Throws
  /// std::invalid_argument if max_distance is negative or NaN.
  std::optional<VolumeDistance> nearest(const Eigen::Vector3d& point,
                                        double max_distance = std::numeric_limits<double>::infinity()) const;

  /// Resizes `first` to points.count. Sets first[i] to the smallest index of the volumes that contain the
  /// i-th visited point, or to -1 if there is none. The result is the same for every Execution. Exceptions of
  /// a PointSource pass through.
  void first_containing(const PointView& points, std::vector<std::int32_t>& first,
                        const Execution& execution = {}) const;

  /// Resizes `hits` to the number of rays. Sets hits[i] to first_hit() of rays[i]. If the ray hits nothing,
  /// hits[i].index is -1. The result is the same for every Execution.
  void first_hits(const std::vector<Ray>& rays, std::vector<VolumeHit>& hits,
                  const Execution& execution = {}) const;

 private:
  struct Nodes;

  std::shared_ptr<Nodes> nodes_;
};

}  // namespace pcl_bv
