// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What the nodes of a VolumeTree should be bounded by, by definition and in long double.
#pragma once

#include <algorithm>
#include <iterator>
#include <limits>
#include <vector>

#include "node_bounds.h"
#include "scattered_volumes.h"
#include "vectors.h"

namespace pcl_bv::testing {

using Real = long double;
using RealVector = Eigen::Matrix<Real, 3, 1>;

inline constexpr Real kFar = std::numeric_limits<Real>::infinity();

// What a node's shape should be, in the frame of the boxes.
struct Slab {
  RealVector direction;
  Real low, high;
};
struct Shape {
  std::vector<Slab> slabs;
  RealVector center = RealVector::Zero();
  Real radius = -kFar;  // of a ball
  Real tolerance = 0;   // floats
  std::vector<std::uint32_t> volumes;
};

struct Tree {
  std::vector<AnyVolume> volumes;
  NodeBounds kind;
  VolumeBoxes boxes;
  NodeShapes shapes;
  std::vector<Shape> expected;  // by number, as those of NodeShapes

  Tree(const std::vector<AnyVolume>& of_volumes, NodeBounds of_kind) : volumes(of_volumes), kind(of_kind) {
    std::vector<PositionBounds> extents;
    std::transform(volumes.begin(), volumes.end(), std::back_inserter(extents), extent_of);
    boxes.build(extents, Serial{});
    shapes.measure(kind, boxes, volumes, Serial{});
    expect_shapes(extents);
  }

  RealVector in_frame(const Vector3d& place) const {
    return (place - vector(boxes.levels().origin)).cast<Real>() * boxes.levels().scale;
  }

  Shape shape_of(const AnyVolume& volume, const PositionBounds& extent) const {
    Shape shape;
    if (empty(volume) || !(extent.low.x >= -1e100 && extent.high.x <= 1e100)) return nothing();
    const Real scale = boxes.levels().scale;
    const Aabb box = aabb(volume);
    const SlabBounds<7, double> bounds(volume);
    const Real room = box.empty() ? kFar : 2 * contains_margin(box);
    shape.slabs = nothing().slabs;
    for (std::size_t i = 3; i < 7; ++i) {
      Slab& slab = shape.slabs[i - 3];
      const Real origin = slab.direction.dot(vector(boxes.levels().origin).cast<Real>());
      slab.low = box.empty() ? -kFar : (bounds.min[i] - origin - room) * scale;
      slab.high = box.empty() ? kFar : (bounds.max[i] - origin + room) * scale;
    }
    shape.center = in_frame(0.5 * vector(extent.low) + 0.5 * vector(extent.high));
    Real radius = (vector(extent.high) - vector(extent.low)).cast<Real>().norm() / 2;
    if (const auto* const sphere = std::get_if<Sphere>(&volume)) {
      radius = Real(sphere->radius()) + contains_margin(box);
      shape.center = in_frame(sphere->center());
    }
    shape.radius = radius * scale * (1 + 0x1p-20L) + 0x1p-20L;
    return shape;
  }

  static Shape nothing() {
    Shape shape;
    for (std::size_t i = 3; i < 7; ++i) {
      const CubeDirection& d = kCubeDirections[i];
      shape.slabs.push_back({RealVector(d[0], d[1], d[2]), kFar, -kFar});
    }
    return shape;
  }

  static Shape joined(const Shape* shapes) {
    Shape all = nothing();
    RealVector low = RealVector::Constant(kFar), high = -low;
    for (std::size_t k = 0; k < kTreeWidth; ++k) {
      all.volumes.insert(all.volumes.end(), shapes[k].volumes.begin(), shapes[k].volumes.end());
      if (shapes[k].radius < 0) continue;
      for (std::size_t i = 0; i < all.slabs.size(); ++i) {
        all.slabs[i].low = std::min(all.slabs[i].low, shapes[k].slabs[i].low);
        all.slabs[i].high = std::max(all.slabs[i].high, shapes[k].slabs[i].high);
      }
      low = low.cwiseMin(shapes[k].center - RealVector::Constant(shapes[k].radius));
      high = high.cwiseMax(shapes[k].center + RealVector::Constant(shapes[k].radius));
    }
    if (!(low[0] <= high[0])) return all;
    all.center = (low + high) / 2;
    for (std::size_t k = 0; k < kTreeWidth; ++k)
      all.radius = std::max(all.radius, (shapes[k].center - all.center).norm() + shapes[k].radius);
    return all;
  }

  void expect_shapes(const std::vector<PositionBounds>& extents) {
    const BoxLevels& levels = boxes.levels();
    expected.assign(levels.groups.size() * kTreeWidth, nothing());
    for (std::size_t item = 0; item < volumes.size(); ++item) {
      const std::uint32_t number = boxes.volume_index(item);
      expected[item] = shape_of(volumes[number], extents[number]);
      expected[item].volumes = {number};
      expected[item].tolerance = 0x1p-21L;
    }
    for (std::size_t level = 1; level < levels.levels; ++level) {
      for (std::size_t i = 0; i < levels.child_counts[level]; ++i) {
        Shape& shape = expected[levels.first[level] * kTreeWidth + i];
        shape = joined(&expected[(levels.first[level - 1] + i) * kTreeWidth]);
        shape.tolerance = 0x1p-21L * static_cast<Real>(level + 1);
      }
    }
  }
};

}  // namespace pcl_bv::testing
