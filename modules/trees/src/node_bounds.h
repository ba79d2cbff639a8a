// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The slabs or spheres of the nodes of a VolumeTree, in addition to the boxes and in the frame of the boxes.
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

  /// Returns whether distances to bounds can be computed. Beyond 2^500 their squares leave the range of
  /// double.
  bool is_in_range() const { return at.cwiseAbs().maxCoeff() < 0x1p500; }
};

/// A ray in the frame of the boxes, at + t u. `at` is from.at. The largest component of u is 1 to 2 in
/// magnitude.
struct FrameRay {
  FramePoint from;
  Eigen::Vector3d u;
  int exponent;             ///< t in the frame is 2^exponent times t of the given ray.
  double underflow_margin;  ///< Bound of the error of `enter` and `exit` by underflow in intersect().

  FrameRay(const VolumeBoxes& boxes, const Coordinates& origin, const Coordinates& direction);
  /// Converts the parameter t of the given ray to the frame. Overflow gives infinity.
  double time(double t) const;
};

/// The slabs or spheres of all nodes, if the tree has any.
class NodeShapes {
 public:
  /// Builds the shapes. Item i of the boxes is volumes[boxes.volume_index(i)].
  void measure(NodeBounds kind, const VolumeBoxes& boxes, const std::vector<AnyVolume>& volumes,
               const ParallelPolicy& policy);

  bool none() const { return slabs_.empty() && balls_.empty(); }

  /// Box k of group g has the shape number 16 g + k. distance() returns a lower bound of the distance from a
  /// query point, or 0 if the point may be inside. enter() returns a lower bound of the t at which a ray
  /// enters, or infinity if the ray misses the shape.
  double distance(std::size_t shape, const FramePoint& point) const;
  double enter(std::size_t shape, const FrameRay& ray) const;

  /// Returns as bits which of the boxes `bits` of a group have a shape that may hold the query point.
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

/// Returns a lower bound of the distance from a query point to a box, or 0 if the point may be inside.
double distance_to_box(const FramePoint& point, const BoxGroup& group, std::size_t k);

/// Returns a lower bound of the t at which a ray enters a box, or infinity if the ray misses it.
double enter_box(const FrameRay& ray, const BoxGroup& group, std::size_t k);

}  // namespace pcl_bv
