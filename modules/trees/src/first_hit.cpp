// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <bit>
#include <limits>

#include "pcl_bv/kernels/swept_ball.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/trees/argument_checks.h"
#include "point_tree_state.h"
#include "vectors.h"

namespace pcl_bv {
using namespace detail;
namespace {

class FirstHit final : public PacketVisitor {
 public:
  FirstHit(const PackedTree& tree, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
           double radius)
      : tree_(tree),
        origin_(origin),
        direction_(direction),
        ball_(tree.boxes, coordinates(origin), coordinates(direction), radius) {}

  std::optional<PointHit> among(UsableIsa isa) {
    visit_along(isa, tree_, ball_, *this);
    return best_.index < 0 ? std::nullopt : std::optional(best_);
  }

  float visit(std::size_t packet, std::uint32_t points) override {
    for (; points != 0; points &= points - 1) {
      const std::size_t at = packet * kTreeWidth + static_cast<std::size_t>(std::countr_zero(points));
      const auto inside =
          Sphere(vector(load_point(points_, at)), ball_.radius).intersect(origin_, direction_);
      if (!inside) continue;
      const PointHit hit{tree_.indices[at], inside->enter};
      if (best_.index < 0 || hit.t < best_.t || (hit.t == best_.t && hit.index < best_.index)) best_ = hit;
    }
    return best_.index < 0 ? std::numeric_limits<float>::max() : ball_.latest_entry(best_.t);
  }

 private:
  const PackedTree& tree_;
  PointView points_ = tree_.view();
  Eigen::Vector3d origin_, direction_;
  SweptBall ball_;
  PointHit best_{-1, 0};
};

// Returns the point with the smallest index inside a sphere that does not move.
std::optional<PointHit> smallest_index_inside(UsableIsa isa, const PackedTree& tree, const Sphere& sphere) {
  std::vector<Neighbor> found;
  list_in_ball(isa, tree, coordinates(sphere.center()), sphere.max_squared_distance(), found);
  if (found.empty()) return std::nullopt;
  const auto lower = [](const Neighbor& a, const Neighbor& b) { return a.index < b.index; };
  return PointHit{std::min_element(found.begin(), found.end(), lower)->index, 0};
}

}  // namespace

std::optional<PointHit> PointTree::first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                             double radius) const {
  const FloatEnvironment environment;
  if (!(radius >= 0 && radius <= kMaxCoordinate))
    throw_out_of_range_value("PointTree: the radius of a moving sphere must be from 0 to 1e100", radius);
  if (empty() || !origin.allFinite() || !direction.allFinite()) return std::nullopt;
  if (direction.isZero(0)) return smallest_index_inside(state().isa, state().tree, Sphere(origin, radius));
  return FirstHit(state().tree, origin, direction, radius).among(state().isa);
}

}  // namespace pcl_bv
