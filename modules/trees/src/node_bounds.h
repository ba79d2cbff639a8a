// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What nodes of a VolumeTree may have besides their boxes. All is in the frame of the boxes.
#pragma once

#include <array>
#include <vector>

#include "pcl_bv/trees/slab_bounds.h"
#include "pcl_bv/trees/volume_tree.h"
#include "volume_boxes.h"

namespace pcl_bv {

/// A place there, and how far from a node's bounds a volume may be that it matters to.
struct FramePlace {
  std::array<double, 3> at;
  double slack;  ///< By coordinate.

  FramePlace(const VolumeBoxes& boxes, const Coordinates& place);
};

/// A ray there: at + t u. The greatest component of u is between 1 and 2.
struct FrameRay {
  FramePlace from;
  std::array<double, 3> u;
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

 private:
  using Slabs = SlabBounds<7, float>;
  struct Ball {
    float center[3] = {0, 0, 0};
    float radius = -1;  // nothing inside
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

/// A lower bound of t where a ray enters a box, given by its sides; infinity if it misses.
double enter_box(const FrameRay& ray, const BoxGroup& group, std::size_t k);

}  // namespace pcl_bv
