// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What nodes of a VolumeTree may have besides their boxes. All is in the frame of the boxes.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "pcl_bv/trees/slab_bounds.h"
#include "pcl_bv/trees/volume_tree.h"
#include "volume_boxes.h"

namespace pcl_bv {

/// A place there, and how far from a node's bounds a volume may be that it matters to.
struct FramePlace {
  Eigen::Vector3d at;
  double slack;  ///< By coordinate.

  FramePlace(const VolumeBoxes& boxes, const Coordinates& place);

  /// Whether bounds of nodes can be told from there: beyond 2^500 squares leave the range of double.
  bool is_in_range() const { return at.cwiseAbs().maxCoeff() < 0x1p500; }
};

/// A ray there: at + t u. The greatest component of u is between 1 and 2.
struct FrameRay {
  FramePlace from;
  Eigen::Vector3d u;
  int exponent;   ///< t of the ray there is t 2^exponent of the one here.
  double margin;  ///< What intersect() may add to both ends where they underflow, with room.

  FrameRay(const VolumeBoxes& boxes, const Coordinates& origin, const Coordinates& direction);
  double time(double t) const;  ///< Rounds down, and up to infinity.
};

class NodeShapes {
 public:
  /// Of items 0, 1, ... that `volumes` has under the boxes' numbers.
  void measure(NodeBounds kind, const VolumeBoxes& boxes, const std::vector<AnyVolume>& volumes,
               const ParallelPolicy& policy);

  bool none() const { return slabs_.empty() && balls_.empty(); }

  /// The shape of box k of group g is number 16 g + k. A lower bound of the distance from a place, 0 where
  /// the place may be inside; of t where a ray enters, infinity if it misses.
  double distance(std::size_t shape, const FramePlace& place) const;
  double enter(std::size_t shape, const FrameRay& ray) const;

  /// Of the boxes of a group, as bits, those whose shape may hold a place.
  std::uint32_t may_hold(std::size_t group, std::uint32_t bits, const FramePlace& place) const;

 private:
  using Slabs = SlabBounds<7, float>;
  struct Ball {
    Eigen::Vector3f center = Eigen::Vector3f::Zero();
    float radius = -std::numeric_limits<float>::infinity();  // nothing inside
  };

  template <typename Shape, typename Item, typename Join>
  void fill(std::vector<Shape>& shapes, const BoxLevels& levels, const ParallelPolicy& policy,
            const Item& item, const Join& join);
  static Slabs slabs_of(const VolumeBoxes& boxes, const AnyVolume& volume);
  static Ball ball_of(const VolumeBoxes& boxes, const AnyVolume& volume);
  static Ball joined(const Ball* balls, std::size_t count);

  std::vector<Slabs> slabs_;
  std::vector<Ball> balls_;
};

/// A lower bound of the distance from a place to a box, 0 where the place may be inside.
double distance_to_box(const FramePlace& place, const BoxGroup& group, std::size_t k);

/// A lower bound of t where a ray enters a box, given by its sides; infinity if it misses.
double enter_box(const FrameRay& ray, const BoxGroup& group, std::size_t k);

}  // namespace pcl_bv
