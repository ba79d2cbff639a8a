// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Questions to many volumes at a time: which of them hold a point, does a ray hit, is another one near.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What a tree's nodes are compared by. All have boxes, which sixteen at a time are looked at; the others are
/// asked about where boxes do not tell. No choice changes an answer.
enum class NodeBounds : std::uint8_t {
  aabb,   ///< Boxes alone: the cheapest to build and to refit.
  dop14,  ///< And slabs along the cube's diagonals (Klosowski et al. 1998); five times as long to build.
  sphere  ///< And spheres; twice as long to build.
};

/// A volume of a tree that a ray hits, and where.
struct VolumeHit {
  std::int32_t index;
  RayInterval interval;
};

/// A volume of a tree and how far it is from a place.
struct VolumeDistance {
  std::int32_t index;
  double distance;
};

struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;  ///< Of any length, which is the unit of where a hit is.
};

/// Volumes of any kinds in the order of a balanced k-d tree of their middles, with boxes around 16, around 16
/// of those and so on.
///
/// Volumes are named by their numbers in the list that they came in. Each question is decided by the volumes'
/// own verbs, as if all were asked one after another: bounds only spare those on which the answer cannot
/// depend. Lists are ascending and replace what was in them. Empty volumes are never found. Volumes that no
/// box is known for, such as hulls whose planes enclose nothing, are asked each time, and so are ellipsoids
/// about rays of which one radius is more than 2^20 times another. Frame and unit are the volumes' own.
///
/// Const calls may run side by side; copies are independent.
class VolumeTree {
 public:
  /// Of no volumes.
  VolumeTree();

  /// O(n log n); 0.2 us for each sphere with boxes, 2.5 us for an Obb, whose aabb() is exact. The same tree
  /// for every Execution. Throws std::invalid_argument for more than 2^31 - 1 volumes and for
  /// Execution::supports.
  explicit VolumeTree(std::vector<AnyVolume> volumes, NodeBounds bounds = NodeBounds::aabb,
                      const Execution& execution = {});

  /// Other volumes in place of the same numbers: those of a next frame, that moved. Answers are as those of a
  /// new tree, which is faster to ask if they moved far. O(n). Throws std::invalid_argument for another
  /// number of them, and then nothing is changed.
  void refit(std::vector<AnyVolume> volumes, const Execution& execution = {});

  std::size_t size() const;  ///< Volumes, empty ones among them.
  const std::vector<AnyVolume>& volumes() const;
  NodeBounds node_bounds() const;

  /// Whether contains() holds for any volume, and for which.
  bool any_containing(const Eigen::Vector3d& point) const;
  void all_containing(const Eigen::Vector3d& point, std::vector<std::int32_t>& indices) const;

  /// The volume that a ray enters first: of those that intersect() says it hits the one with the least enter,
  /// of equal ones the first.
  std::optional<VolumeHit> first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// All that it hits.
  void all_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
               std::vector<VolumeHit>& hits) const;

  /// Those whose aabb() overlaps the box.
  void all_touching(const Aabb& box, std::vector<std::int32_t>& indices) const;

  /// Those that overlap it, as overlaps() of pairs.h says; each whose box is near is made ready for that
  /// first.
  void all_overlapping(const AnyVolume& volume, std::vector<std::int32_t>& indices) const;

  /// That with the least distance() from the point, of equal ones the first, if it is at most max_distance.
  /// None for a point with a NaN. Throws std::invalid_argument for a max_distance below 0 or NaN.
  std::optional<VolumeDistance> nearest(const Eigen::Vector3d& point,
                                        double max_distance = std::numeric_limits<double>::infinity()) const;

  /// For each visited point the number of the first volume that contains() it, or -1: labels, to set first[0]
  /// to first[points.count - 1]. The same for every Execution. Throws what a PointSource throws.
  void first_containing(const PointView& points, std::vector<std::int32_t>& first,
                        const Execution& execution = {}) const;

  /// For each ray its first_hit(), with index -1 where there is none.
  void first_hits(const std::vector<Ray>& rays, std::vector<VolumeHit>& hits,
                  const Execution& execution = {}) const;

 private:
  struct Nodes;

  std::shared_ptr<Nodes> nodes_;
};

}  // namespace pcl_bv
