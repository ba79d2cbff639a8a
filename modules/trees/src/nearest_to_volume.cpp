// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <array>

#include "box_relation.h"
#include "box_walk.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/trees/point_tree.h"
#include "pcl_bv/volumes/pairs.h"
#include "refusal.h"
#include "vectors.h"

namespace pcl_bv {
namespace {

class NearestToVolume {
 public:
  NearestToVolume(const PackedTree& tree, const AnyVolume& volume, double limit)
      : tree_(tree), body_(volume), best_{-1, limit} {
    const Aabb box = aabb(volume);
    size_ = taxicab3(box.min()) + taxicab3(box.max());
  }

  std::optional<PointDistance> run() {
    descend(
        tree_.boxes, [&](std::size_t group) { return least_distances(tree_.boxes.groups[group]); },
        [&] { return best_.distance; }, [&](std::size_t packet) { ask_packet(packet); });
    return best_.index < 0 ? std::nullopt : std::optional(best_);
  }

 private:
  // No point of the box is nearer: distances differ by no more than places do, and distance() is short of the
  // true one by 1e-12 of it and of the sizes.
  double least_distance(const PlainBox& box) const {
    const Eigen::Vector3d middle = 0.5 * (box.low + box.high);
    const double reach = 0.5 * norm3(Eigen::Vector3d(box.high - box.low));
    const double away = distance(body_, middle);
    return away - reach - 0x1p-36 * (away + reach + size_ + taxicab3(middle));
  }

  std::array<double, kTreeWidth> least_distances(const BoxGroup& group) const {
    std::array<double, kTreeWidth> least;
    for (std::size_t k = 0; k < kTreeWidth; ++k) {
      const PlainBox box = plain_box(tree_.boxes, group, k);
      least[k] = box.low.x() <= box.high.x() ? least_distance(box) : kInfinity;
    }
    return least;
  }

  void ask_packet(std::size_t packet) {
    const PointView points = tree_.view();
    const std::size_t first = packet * kTreeWidth;
    for (std::size_t i = first; i < std::min(first + kTreeWidth, tree_.count); ++i) {
      const Coordinates p = load_point(points, i);
      if (!is_valid(p)) continue;
      const PointDistance found{tree_.numbers[i], distance(body_, vector(p))};
      const bool nearer = found.distance < best_.distance || (found.distance == best_.distance &&
                                                              (best_.index < 0 || found.index < best_.index));
      if (nearer) best_ = found;
    }
  }

  const PackedTree& tree_;
  ConvexBody body_;
  double size_;
  PointDistance best_;
};

}  // namespace

std::optional<PointDistance> PointTree::nearest_to(const AnyVolume& volume, double max_distance) const {
  const FloatEnvironment environment;
  require_distance("PointTree", max_distance);
  if (empty() || pcl_bv::empty(volume)) return std::nullopt;
  return NearestToVolume(tree_, volume, max_distance).run();
}

}  // namespace pcl_bv
