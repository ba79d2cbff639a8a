// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/partial_clouds.h"

#include <algorithm>
#include <cstdint>

#include "hull/convex_hull.h"
#include "partial/partial_state.h"
#include "pcl_bv/numeric/float_environment.h"
#include "support/support_search.h"

namespace pcl_bv::detail {
namespace {

// Adds the counts, support points, extreme points and moments of clouds to those of the clouds before them.
class CloudJoiner {
 public:
  explicit CloudJoiner(ScalarType scalar) { all_.scalar = scalar; }

  void add(PartialState cloud) {
    cloud.scalar = all_.scalar;
    cloud = reduced(std::move(cloud));
    const std::size_t before = all_.used + all_.dropped;
    const SupportDirections& directions = SupportDirections::of(DirectionSet::dop26);
    for (std::size_t i = 0; i < all_.support_points.size(); ++i) {
      cloud.support_points[i].index += before;
      keep_larger_projection(directions.support_direction(i), cloud.support_points[i],
                             all_.support_points[i]);
    }
    for (const NumberedPoint& p : cloud.extreme)
      all_.extreme.push_back({before + p.number, p.point});
    // Otherwise 10 000 clouds would need 300 MB.
    if (all_.extreme.size() > max_points_) drop_inner_points();
    all_.used += cloud.used;
    all_.dropped += cloud.dropped;
    all_.blocks.append(clouds_++, moments_of_all(cloud));
  }

  PartialState finish() {
    drop_inner_points();
    return std::move(all_);
  }

 private:
  void drop_inner_points() {
    keep_extreme(all_.extreme);
    max_points_ = std::max(max_points_, 2 * all_.extreme.size());
  }

  PartialState all_;
  std::size_t clouds_ = 0;
  std::size_t max_points_ = 100'000;
};

}  // namespace

Partial join_clouds(const std::vector<Partial>& clouds) {
  const FloatEnvironment environment;
  ScalarType scalar = ScalarType::float32;
  std::size_t points = 0;
  for (const Partial& cloud : clouds) {
    points += cloud.size();
    if (cloud.size() > 0 && PartialAccess::state(cloud).scalar == ScalarType::float64)
      scalar = ScalarType::float64;
  }
  if (points > Partial::kMaxStored) {
    CloudJoiner joiner(scalar);
    for (const Partial& cloud : clouds)
      if (cloud.size() > 0) joiner.add(PartialAccess::state(cloud));
    return PartialAccess::partial(joiner.finish());
  }
  PartialState all;
  all.scalar = scalar;
  for (const Partial& cloud : clouds) {
    const std::size_t before = all.loose.size();
    for (const NumberedPoint& p : PartialAccess::state(cloud).loose)
      all.loose.push_back({before + p.number, p.point});
  }
  return PartialAccess::partial(std::move(all));
}

}  // namespace pcl_bv::detail
