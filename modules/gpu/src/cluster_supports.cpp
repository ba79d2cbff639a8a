// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/gpu/cluster_supports.h"

#include <stdexcept>

#include "support_pass.h"

namespace pcl_bv::detail {
namespace {

// The device has the coordinates of float points themselves, so its box must be that of the support points.
void require_same_box(const DeviceExtremes& found, const Supports& supports) {
  bool same = true;
  for (std::size_t axis = 0; axis < 3 && supports.used > 0; ++axis)
    same =
        same && supports.along[axis].low == found.low[axis] && supports.along[axis].high == found.high[axis];
  if (!same) throw std::invalid_argument("fit: the points have changed since they were copied to the device");
}

}  // namespace

std::optional<Supports> supports_on_device(const DevicePoints& cloud, DirectionSet set, SupportDetail detail,
                                           const FitExecution& execution) {
  const PointView points = cloud.points();
  const bool bounds = detail == SupportDetail::bounds && !cloud.rounded();
  const DeviceExtremes found = find_extremes(cloud, set, !bounds);
  if (bounds) return supports_of_bounds(points, found.low, found.high, found.dropped, execution);
  if (!found.complete) return std::nullopt;
  std::vector<std::byte> storage;
  std::vector<std::int32_t> near = found.near_points;
  const std::vector<PointView> candidates =
      near.empty() ? cloud.blocks(found.candidates, storage) : std::vector<PointView>{cloud.select(near)};
  Supports supports = find_supports_among(points, candidates, set, found.dropped, execution);
  if (!cloud.rounded()) require_same_box(found, supports);
  return supports;
}

void ClusterSupports::find(const std::vector<PointView>& views, DirectionSet set,
                           const Execution& execution) {
  found_.clear();
  found_.resize(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i].count < kFewestPoints || views[i].count > GpuCloud::max_points) continue;
    const GpuCloud cloud(device_, views[i], HostPoints::keep, execution);
    found_[i] = {cloud, supports_on_device(cloud.on_device(), set, SupportDetail::points, execution),
                 far_blocks_on_device(cloud.on_device())};
  }
}

FitExecution ClusterSupports::known(std::size_t i, const Execution& execution) const {
  FitExecution known(execution);
  if (i >= found_.size() || !found_[i]) return known;
  if (found_[i]->supports) known.supports = &*found_[i]->supports;
  known.far_blocks = found_[i]->far_blocks.get();
  return known;
}

}  // namespace pcl_bv::detail
