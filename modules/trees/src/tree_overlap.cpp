// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tree_overlap.h"

#include <algorithm>
#include <cmath>

#include "box_relation.h"
#include "grown.h"
#include "image.h"
#include "pcl_bv/numeric/directed.h"
#include "volume_walk.h"

namespace pcl_bv {
namespace {

// What squared distances, as Neighbor says, of points within `distance` are at most: six roundings and
// underflow.
double square_within(double distance) {
  return distance * distance * (1 + 0x1p-48) + 0x1p-1000;
}

// The boxes of the tree that moves, as long as a point of the other one is near; then point by point.
class TreeOverlap {
 public:
  TreeOverlap(const PointTree& points, const PackedTree& moving, const Eigen::Isometry3d& pose, double margin)
      : points_(points), moving_(moving), pose_(pose), margin_(margin) {}

  bool visit(std::size_t level, std::size_t number) const {
    const BoxLevels& boxes = moving_.boxes;
    const BoxGroup& group = boxes.groups[boxes.first[level] + number];
    const std::size_t first = number * kTreeWidth, end = std::min(first + kTreeWidth, boxes.below[level]);
    for (std::size_t item = first; item < end; ++item) {
      const PlainBox box = plain_box(boxes, group, item - first);
      if (!(box.low.x() <= box.high.x()) || !near(box)) continue;
      if (level > 0 ? visit(level - 1, item) : any_near(item)) return true;
    }
    return false;
  }

 private:
  bool near(const PlainBox& box) const {
    const AnyVolume moved = grown(Obb(Aabb(box.low, box.high)).transformed(pose_), margin_);
    return walk_inside(points_.isa(), points_.packed(), moved,
                       [](std::size_t, std::uint32_t) { return true; });
  }

  bool any_near(std::size_t packet) const {
    const PointView view = moving_.view();
    const std::size_t first = packet * kTreeWidth, end = std::min(first + kTreeWidth, moving_.count);
    for (std::size_t i = first; i < end; ++i) {
      const Coordinates p = load_point(view, i);
      if (!is_valid(p)) continue;
      const Image image = image_of(pose_, p);
      const double limit = square_within(add_up(margin_, image.error));
      if (any_in_ball(points_.isa(), points_.packed(), image.place, limit)) return true;
    }
    return false;
  }

  const PointTree& points_;
  const PackedTree& moving_;
  const Eigen::Isometry3d& pose_;
  double margin_;
};

}  // namespace

bool trees_within(const PointTree& points, const PointTree& others, const Eigen::Isometry3d& pose,
                  double margin) {
  return TreeOverlap(points, others.packed(), pose, margin).visit(others.packed().boxes.levels - 1, 0);
}

}  // namespace pcl_bv
