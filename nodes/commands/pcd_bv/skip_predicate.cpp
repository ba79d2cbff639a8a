// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "skip_predicate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::detail {
namespace {

using Box = Eigen::AlignedBox3d;

constexpr double kMargin = 1e-9;  // relative; far more than the rounding of a distance

class FilteredBoxes {
 public:
  FilteredBoxes(const FilterConfig& filter, const std::optional<std::vector<Aabb>>& kept_extents)
      : range_min_(filter.range_min), range_max_(filter.range_max) {
    if (kept_extents) {
      regions_.emplace();
      for (const Aabb& extent : *kept_extents)
        regions_->emplace_back(extent.min(), extent.max());
    }
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

BoxPredicate make_skip_predicate(const FilterConfig& filter,
                                 const std::optional<std::vector<Aabb>>& kept_extents) {
  return FilteredBoxes(filter, kept_extents);
}

BoxPredicate make_skip_predicate(const Job& job, const Options& options, const FramePipeline& pipeline) {
  const PipelineConfig& config = options.pipeline;
  const FilterConfig& filter = config.filter;
  const bool writes_all = options.info || job.labels || job.image || job.view_html || job.mesh;
  const bool uses_all =
      options.origin.requested || config.cluster.class_field ||
      (config.ground.method != GroundMethod::none && config.ground.method != GroundMethod::slope) ||
      config.effective_refine() != Refine::off;
  if (writes_all || uses_all || job.tiles || job.error || job.recording ||
      lower_case_extension(job.input) != ".laz")
    return {};
  const auto kept_extents = pipeline.kept_extents();
  if (!kept_extents && filter.range_max == std::numeric_limits<double>::infinity()) return {};
  return make_skip_predicate(filter, kept_extents);
}

}  // namespace pcl_bv::detail
