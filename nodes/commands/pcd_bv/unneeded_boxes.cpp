// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "unneeded_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/report/read_volumes.h"

namespace pcl_bv::detail {
namespace {

using Box = Eigen::AlignedBox3d;

constexpr double kMargin = 1e-9;  // relative; far more than the rounding of a distance

// The boxes around the volumes to keep; nullopt if the filter keeps all regions.
std::optional<std::vector<Box>> kept_regions(const FilterConfig& filter) {
  std::vector<Box> boxes;
  bool any = false;
  for (const RegionConfig& region : filter.regions) {
    if (!region.keep) continue;
    any = true;
    for (const AnyVolume& volume : region.volumes.empty() ? read_volumes(region.file) : region.volumes) {
      const Aabb around = aabb(volume);
      const double size = std::max(around.min().cwiseAbs().maxCoeff(), around.max().cwiseAbs().maxCoeff());
      const Eigen::Vector3d margin =
          Eigen::Vector3d::Constant(region.padding * (1 + kMargin) + kMargin * size);
      boxes.emplace_back(around.min() - margin, around.max() + margin);
    }
  }
  if (!any) return std::nullopt;
  return boxes;
}

class FilteredBoxes {
 public:
  explicit FilteredBoxes(const FilterConfig& filter)
      : range_min_(filter.range_min), range_max_(filter.range_max), regions_(kept_regions(filter)) {
    if (filter.own_box_min) own_box_ = Box(*filter.own_box_min, *filter.own_box_max);
  }

  bool operator()(const LasBox& las) const {
    const Box box(Eigen::Vector3d(las.low[0], las.low[1], las.low[2]),
                  Eigen::Vector3d(las.high[0], las.high[1], las.high[2]));
    const double nearest = box.exteriorDistance(Eigen::Vector3d::Zero().eval()) * (1 - kMargin);
    const double farthest = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).norm() * (1 + kMargin);
    if (nearest > range_max_ || farthest < range_min_) return true;
    const bool in_range =
        nearest >= range_min_ && farthest <= range_max_ && !(own_box_ && own_box_->intersects(box));
    return in_range && regions_ && std::none_of(regions_->begin(), regions_->end(), [&](const Box& region) {
             return region.intersects(box);
           });
  }

 private:
  double range_min_, range_max_;
  std::optional<std::vector<Box>> regions_;
  std::optional<Box> own_box_;
};

}  // namespace

SkipsBox boxes_without_kept_points(const FilterConfig& filter) {
  return FilteredBoxes(filter);
}

SkipsBox unneeded_boxes(const Job& job, const Options& options) {
  const FilterConfig& filter = options.pipeline.filter;
  const bool keeps_regions = std::any_of(filter.regions.begin(), filter.regions.end(),
                                         [](const RegionConfig& region) { return region.keep; });
  const bool needs_all = options.info || job.labels || job.image || job.view_html || job.mesh ||
                         options.origin.requested || options.pipeline.cluster.class_field;
  if (needs_all || job.tiles || job.error || job.recording || lower_case_extension(job.input) != ".laz" ||
      (!keeps_regions && filter.range_max == std::numeric_limits<double>::infinity()))
    return {};
  return boxes_without_kept_points(filter);
}

}  // namespace pcl_bv::detail
