// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tree_overlap.h"

#include "box_relation.h"
#include "inflated.h"
#include "volume_walk.h"

namespace pcl_bv::detail {
namespace {

// Descends into the boxes of the moved tree that are near a point of the other tree. Tests the points in the
// packets of these boxes.
class TreeOverlap {
 public:
  TreeOverlap(const PointTree& points, const PackedTree& moving, const Eigen::Isometry3d& pose, double margin)
      : points_(points), moving_(moving), pose_(pose), margin_(margin) {}

  bool visit(std::size_t level, std::size_t number) const {
    const BoxLevels& boxes = moving_.boxes;
    const BoxGroup& group = boxes.groups[boxes.first[level] + number];
    for (std::size_t k = 0; k < kTreeWidth; ++k) {
      const PlainBox box = plain_box(boxes, group, k);
      if (!(box.low.x() <= box.high.x()) || !near(box)) continue;
      const std::size_t item = number * kTreeWidth + k;
      if (level > 0 ? visit(level - 1, item) : any_near(item)) return true;
    }
    return false;
  }

 private:
  bool near(const PlainBox& box) const {
    const AnyVolume moved = inflated(Obb(Aabb(box.low, box.high)).transformed(pose_), margin_);
    return walk_inside(points_.isa(), packed_tree(points_), moved,
                       [](std::size_t, std::uint32_t) { return true; });
  }

  bool any_near(std::size_t packet) const {
    const PointView view = moving_.view();
    for (std::size_t k = 0; k < kTreeWidth; ++k) {
      const Coordinates p = load_point(view, packet * kTreeWidth + k);
      if (is_valid(p) && any_within(points_, transform_point(pose_, p), margin_)) return true;
    }
    return false;
  }

  const PointTree& points_;
  const PackedTree& moving_;
  const Eigen::Isometry3d& pose_;
  double margin_;
};

}  // namespace

// The factor 1 + 2^-48 covers ten roundings, which together are at most 2^-49. Six are in
// Neighbor::squared_distance, two are in this function, and two are in the argument `distance`. The square
// does not underflow, because the error of a transformed point is at least 2^-500.
bool any_within(const PointTree& points, const TransformedPoint& point, double distance) {
  const double limit = distance + point.error;
  return any_in_ball(points.isa(), packed_tree(points), point.position, limit * limit * (1 + 0x1p-48));
}

bool trees_within(const PointTree& points, const PointTree& others, const Eigen::Isometry3d& pose,
                  double margin) {
  return TreeOverlap(points, packed_tree(others), pose, margin)
      .visit(packed_tree(others).boxes.levels - 1, 0);
}

}  // namespace pcl_bv::detail
