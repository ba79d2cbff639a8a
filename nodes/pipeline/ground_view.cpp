// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ground_view.h"

#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "ground.h"
#include "kept_points.h"
#include "pcl_bv/segmentation/slope_surface.h"

namespace pcl_bv::detail {
namespace {

class PointsAboveGround final : public PointSource {
 public:
  PointsAboveGround(const PointView& points, SlopeSurface surface)
      : points_(points), surface_(std::move(surface)) {}

  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override {
    const LoadedPoints part(points_, first - points_.first, count);
    std::vector<std::uint8_t> ground(count);
    surface_.classify(part.view(), ground.data());
    return kept_points(
        part.view(), first, [&](std::size_t i) { return ground[i] == 0; }, buffer);
  }

 private:
  PointView points_;
  SlopeSurface surface_;
};

}  // namespace

GroundView remove_slope_ground(const PointView& points, const GroundConfig& config,
                               const Execution& execution) {
  if (points.indices != nullptr)
    throw std::invalid_argument("remove_slope_ground: the view has an index list");
  SlopeSurface surface(points, slope_settings(config), execution);
  GroundView view;
  view.valid = surface.valid_points();
  view.owner = std::make_shared<const PointsAboveGround>(points, std::move(surface));
  view.points = view_of(*view.owner, points.count, points.scalar);
  view.points.first = points.first;
  return view;
}

}  // namespace pcl_bv::detail
