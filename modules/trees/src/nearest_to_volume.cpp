// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

#include "body_distance.h"
#include "box_walk.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/trees/argument_checks.h"
#include "point_tree_state.h"
#include "vectors.h"

namespace pcl_bv {
using namespace detail;
namespace {

class NearestToVolume {
 public:
  NearestToVolume(const PackedTree& tree, const AnyVolume& volume, double limit)
      : tree_(tree), body_(volume), best_{kNone, limit} {}

  std::optional<PointDistance> run() {
    visit_nearest_first(
        tree_.boxes, [&](std::size_t group) { return min_distances(tree_.boxes.groups[group]); },
        [&] { return best_.distance; }, [&](std::size_t packet) { test_packet(packet); });
    return best_.index == kNone ? std::nullopt : std::optional(best_);
  }

 private:
  static constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::max();

  std::array<double, kTreeWidth> min_distances(const BoxGroup& group) const {
    std::array<double, kTreeWidth> distances;
    for (std::size_t k = 0; k < kTreeWidth; ++k)  // NaN for missing boxes of the last group
      distances[k] = body_.lower_bound(plain_box(tree_.boxes, group, k));
    return distances;
  }

  void test_packet(std::size_t packet) {
    const PointView points = tree_.view();
    for (std::size_t k = 0; k < kTreeWidth; ++k) {
      const std::size_t i = packet * kTreeWidth + k;
      const Coordinates p = load_point(points, i);
      if (!is_valid(p)) continue;
      const PointDistance found{tree_.indices[i], body_.distance_to(vector(p))};
      if (std::tie(found.distance, found.index) < std::tie(best_.distance, best_.index)) best_ = found;
    }
  }

  const PackedTree& tree_;
  BodyDistance body_;
  PointDistance best_;
};

}  // namespace

std::optional<PointDistance> PointTree::nearest_to(const AnyVolume& volume, double max_distance) const {
  const FloatEnvironment environment;
  require_distance("PointTree", max_distance);
  if (pcl_bv::empty(volume)) return std::nullopt;
  return NearestToVolume(state().tree, volume, max_distance).run();
}

}  // namespace pcl_bv
