// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "volume_boxes.h"

#include "convex_region.h"
#include "pcl_bv/numeric/constants.h"
#include "vectors.h"

namespace pcl_bv::detail {
namespace {

bool is_nonempty(const PositionBounds& extent) {
  return extent.low.x <= extent.high.x && extent.low.y <= extent.high.y && extent.low.z <= extent.high.z;
}

bool has_box(const PositionBounds& extent) {
  return is_nonempty(extent) && is_valid(extent.low) && is_valid(extent.high);
}

PositionBounds around(const std::vector<PositionBounds>& extents) {
  PositionBounds all = {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const PositionBounds& extent : extents) {
    if (!has_box(extent)) continue;
    all.low = coordinates(vector(all.low).cwiseMin(vector(extent.low)));
    all.high = coordinates(vector(all.high).cwiseMax(vector(extent.high)));
  }
  return all;
}

}  // namespace

double contains_margin(const Aabb& box) {
  return 0x1p-36 * std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()) + 0x1p-470;
}

PositionBounds extent_of(const AnyVolume& volume) {
  const Aabb box = aabb(volume);
  if (empty(volume)) return {coordinates(box.min()), coordinates(box.max())};
  if (std::holds_alternative<Kdop>(volume) || std::holds_alternative<Hull>(volume) ||
      std::holds_alternative<Prism>(volume)) {
    const ConvexRegion region = convex_region(volume);
    return {coordinates(vector(region.low).cwiseMin(box.min())),
            coordinates(vector(region.high).cwiseMax(box.max()))};
  }
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(contains_margin(box));
  return {coordinates(box.min() - margin), coordinates(box.max() + margin)};
}

void VolumeBoxes::build(const std::vector<PositionBounds>& extents, const ParallelPolicy& policy) {
  const PositionBounds all = around(extents);
  SpatialOrder<double> order;
  PositionedItem<double>* const items = order.reset(extents.size());
  // Returns the position at which volumes without a box are sorted. If no volume has a box, all.low is
  // infinite, but the position is still valid.
  const auto anywhere = [&](std::size_t axis) { return std::min(all.low[axis], kMaxCoordinate); };
  for (std::size_t i = 0; i < extents.size(); ++i) {
    items[i].index = static_cast<std::int64_t>(i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double middle = extents[i].low[axis] / 2 + extents[i].high[axis] / 2;
      items[i].position[axis] = has_box(extents[i]) ? middle : anywhere(axis);
    }
  }
  order.sort(extents.size(), policy);
  order_.resize(extents.size());
  for (std::size_t item = 0; item < extents.size(); ++item)
    order_[item] = static_cast<std::uint32_t>(order[item].index);
  refit(extents);
}

void VolumeBoxes::refit(const std::vector<PositionBounds>& extents) {
  reset_levels(boxes_, extents.size(), around(extents));
  without_box_.clear();
  for (std::size_t item = 0; item < extents.size(); ++item) {
    const PositionBounds& extent = extents[order_[item]];
    if (has_box(extent)) {
      set_item_box(boxes_, item, extent.low, extent.high);
    } else if (is_nonempty(extent)) {
      without_box_.push_back(order_[item]);
    }
  }
  std::sort(without_box_.begin(), without_box_.end());
  raise_levels(boxes_);
}

BoxQuery VolumeBoxes::query(const Coordinates& low, const Coordinates& high) const {
  BoxQuery query;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low_x = to_frame(low[axis], axis), high_x = to_frame(high[axis], axis);
    query.low[axis] = static_cast<float>(std::clamp(low_x - margin(low_x), -0x1p100, 0x1p100));
    query.high[axis] = static_cast<float>(std::clamp(high_x + margin(high_x), -0x1p100, 0x1p100));
  }
  return query;
}

}  // namespace pcl_bv::detail
