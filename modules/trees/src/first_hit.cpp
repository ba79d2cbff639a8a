// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <bit>
#include <limits>

#include "pcl_bv/kernels/swept_ball.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/trees/argument_checks.h"
#include "pcl_bv/volumes/ray_through_sphere.h"
#include "point_tree_state.h"
#include "vectors.h"

namespace pcl_bv {
using namespace detail;
namespace {

// Finds the first touch. Sphere::intersect() is called only for points whose bounds overlap those of the
// earliest touch so far, mostly for one point.
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
    measure_pending();
    return hit_.index < 0 ? std::nullopt : std::optional(PointHit{hit_.index, hit_.t});
  }

  float visit(std::size_t packet, std::uint32_t points) override {
    for (; points != 0; points &= points - 1)
      consider(packet * kTreeWidth + static_cast<std::size_t>(std::countr_zero(points)));
    return ball_.latest_entry(bounds_.max);
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  Coordinates point(std::size_t at) const {
    const auto of = [&](const auto& packets) -> Coordinates {
      const auto& packet = packets[at / kTreeWidth];
      const std::size_t k = at % kTreeWidth;
      return {*packet.at(0, k), *packet.at(1, k), *packet.at(2, k)};
    };
    return tree_.scalar == ScalarType::float32 ? of(tree_.floats) : of(tree_.doubles);
  }

  void consider(std::size_t at) {
    const TouchBounds touch = ball_.touch(point(at), bounds_.max);
    if (!touch.is_possible()) return;
    if (touch.max < bounds_.min) {
      bounds_ = touch;
      pending_ = at;
    } else {
      measure_pending();
      measure(at);
    }
  }

  void measure_pending() {
    if (pending_ == kNone) return;
    hit_.index = -1;
    measure(pending_);
    pending_ = kNone;
  }

  void measure(std::size_t at) {
    const auto inside = intersect_sphere(vector(point(at)), ball_.radius, origin_, direction_);
    if (!inside) return;
    const PointHit hit{tree_.indices[at], inside->enter};
    if (hit_.index >= 0 && !(hit.t < hit_.t || (hit.t == hit_.t && hit.index < hit_.index))) return;
    hit_ = hit;
    bounds_ = ball_.bounds_of_time(hit.t);
  }

  const PackedTree& tree_;
  const Eigen::Vector3d &origin_, &direction_;
  SweptBall ball_;
  TouchBounds bounds_{kInfinity, kInfinity};  // of the earliest touch so far
  std::size_t pending_ = kNone;               // the point of this touch if it was not measured yet
  PointHit hit_{-1, 0};                       // the earliest measured point; stale while `pending_` is set
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
