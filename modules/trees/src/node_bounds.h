// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Bounds of the nodes of a VolumeTree in addition to their boxes, all in the frame of the boxes.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "pcl_bv/trees/slab_bounds.h"
#include "pcl_bv/trees/volume_tree.h"
#include "volume_boxes.h"

namespace pcl_bv {

/// A query point in the frame of the boxes, and the margin by which bounds are extended.
struct FramePoint {
  Eigen::Vector3d at;
  /// Margin of each coordinate: VolumeBoxes::margin().
  double margin;

  FramePoint(const VolumeBoxes& boxes, const Coordinates& point);

  /// Returns whether distances to bounds can be computed: beyond 2^500 squares leave the range of double.
  bool is_in_range() const { return at.cwiseAbs().maxCoeff() < 0x1p500; }
};

/// A ray in the frame of the boxes: at + t u, where `at` is from.at. The largest component of u is from 1 to
/// 2.
struct FrameRay {
  FramePoint from;
  Eigen::Vector3d u;
  int exponent;             ///< t in the frame is 2^exponent times t of the given ray.
  double underflow_margin;  ///< Bound of what underflow in intersect() adds to either end.

  FrameRay(const VolumeBoxes& boxes, const Coordinates& origin, const Coordinates& direction);
  /// Converts t of the given ray to the frame. Overflow gives infinity.
  double time(double t) const;
};

/// The slabs or spheres of all nodes, if the tree has any.
class NodeShapes {
 public:
  /// Builds the shapes. Item i is volumes[boxes.volume_index(i)].
  void measure(NodeBounds kind, const VolumeBoxes& boxes, const std::vector<AnyVolume>& volumes,
               const ParallelPolicy& policy);

  bool none() const { return slabs_.empty() && balls_.empty(); }

  /// The shape of box k of group g has the number 16 g + k. distance() is a lower bound of the distance from
  /// a query point, 0 if the point may be inside. enter() is a lower bound of t where a ray enters, infinity
  /// if the ray misses.
  double distance(std::size_t shape, const FramePoint& point) const;
  double enter(std::size_t shape, const FrameRay& ray) const;

  /// Returns those of the boxes `bits` of a group whose shape may hold the query point, as bits.
  std::uint32_t may_contain(std::size_t group, std::uint32_t bits, const FramePoint& point) const;

 private:
  using Slabs = SlabBounds<7, float>;
  struct Ball {
    Eigen::Vector3f center = Eigen::Vector3f::Zero();
    float radius = -std::numeric_limits<float>::infinity();  // empty
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

/// Returns a lower bound of the distance from a query point to a box; 0 if the point may be inside.
double distance_to_box(const FramePoint& point, const BoxGroup& group, std::size_t k);

/// Returns a lower bound of t where a ray enters a box; infinity if the ray misses.
double enter_box(const FrameRay& ray, const BoxGroup& group, std::size_t k);

}  // namespace pcl_bv
