// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ground_view.h"

#include <bit>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "ground.h"
#include "kept_points.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/segmentation/slope_surface.h"

namespace pcl_bv::detail {
namespace {

class PointsAboveGround final : public PointSource {
 public:
  PointsAboveGround(const PointView& points, SlopeSurface surface)
      : points_(points), own_(std::move(surface)), surface_(*own_) {}
  PointsAboveGround(const PointView& points, const SlopeSurface& surface, GroundBits& bits)
      : points_(points), surface_(surface), bits_(&bits) {}

  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override {
    const LoadedPoints part(points_, first - points_.first, count);
    std::vector<std::uint8_t> ground(count);
    const std::size_t outside = surface_.classify(part.view(), ground.data());
    if (bits_ != nullptr) {
      if (outside > 0) throw IoError("the inputs have changed since --ground-parts were made");
      bits_->add(first, ground);
    }
    return kept_points(
        part.view(), first, [&](std::size_t i) { return ground[i] == 0; }, buffer);
  }

 private:
  PointView points_;
  std::optional<SlopeSurface> own_;
  const SlopeSurface& surface_;
  GroundBits* bits_ = nullptr;
};

GroundView view_above(const PointView& points, std::shared_ptr<const PointSource> above) {
  GroundView view;
  view.owner = std::move(above);
  view.points = view_of(*view.owner, points.count, points.scalar);
  view.points.first = points.first;
  return view;
}

}  // namespace

GroundView remove_slope_ground(const PointView& points, const GroundConfig& config,
                               const Execution& execution) {
  if (points.indices != nullptr)
    throw std::invalid_argument("remove_slope_ground: the view has an index list");
  SlopeSurface surface(points, slope_settings(config), execution);
  const std::size_t valid = surface.valid_points();
  GroundView view = view_above(points, std::make_shared<const PointsAboveGround>(points, std::move(surface)));
  view.valid = valid;
  return view;
}

GroundView remove_slope_ground(const PointView& points, const SlopeSurface& surface, GroundBits& bits) {
  return view_above(points, std::make_shared<const PointsAboveGround>(points, surface, bits));
}

void GroundBits::add(std::size_t first, const std::vector<std::uint8_t>& ground) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < ground.size(); ++i) {
    const std::size_t bit = first - first_ + i;
    if (ground[i] != 0) bits |= std::uint64_t{1} << bit % 64;
    if (bit % 64 != 63 && i + 1 < ground.size()) continue;
    if (bits != 0) words_[bit / 64].fetch_or(bits, std::memory_order_relaxed);
    bits = 0;
  }
}

std::size_t GroundBits::count() const {
  std::size_t count = 0;
  for (const std::uint64_t word : words_)
    count += static_cast<std::size_t>(std::popcount(word));
  return count;
}

}  // namespace pcl_bv::detail
