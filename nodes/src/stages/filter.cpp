// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/filter.h"

#include <limits>
#include <stdexcept>

#include "pcl_bv/kernels/chunks.h"
#include "pcl_bv/report/read_volumes.h"

namespace pcl_bv {
namespace {

std::unique_ptr<const RegionMask> mask_of(const std::vector<RegionConfig>& regions, bool keep) {
  std::vector<Region> grown;
  bool any = false;
  for (const RegionConfig& region : regions) {
    if (region.keep != keep) continue;
    any = true;
    for (const AnyVolume& volume : region.volumes.empty() ? read_volumes(region.file) : region.volumes)
      grown.push_back({volume, region.padding});
  }
  return any ? std::make_unique<const RegionMask>(grown) : nullptr;
}

}  // namespace

PointFilter::PointFilter(const FilterConfig& config, UsableIsa isa)
    : min2_(config.range_min * config.range_min),
      max2_(config.range_max * config.range_max),
      boxed_(config.own_box_min.has_value()),
      low_(config.own_box_min.value_or(Eigen::Vector3d::Zero())),
      high_(config.own_box_max.value_or(Eigen::Vector3d::Zero())),
      dropped_(mask_of(config.regions, false)),
      cropped_(mask_of(config.regions, true)),
      isa_(isa) {}

bool PointFilter::keeps_all() const {
  return min2_ == 0 && max2_ == std::numeric_limits<double>::infinity() && !boxed_ && !dropped_ && !cropped_;
}

template <typename T>
void PointFilter::judge_distances(const PointView& points, std::vector<Verdict>& verdicts) const {
  for (std::size_t i = 0; i < points.count; ++i) {
    T p[3];
    load_point(points, i, p);
    const double x = p[0], y = p[1], z = p[2];
    const double distance2 = (x * x + y * y) + z * z;
    // The squares of finite floats are finite in double: one comparison instead of three.
    const bool valid =
        sizeof(T) == 4 ? distance2 < std::numeric_limits<double>::infinity() : is_valid({x, y, z});
    bool in_range = distance2 >= min2_ && distance2 <= max2_;
    if (boxed_) {
      in_range = in_range && !(x >= low_.x() && x <= high_.x() && y >= low_.y() && y <= high_.y() &&
                               z >= low_.z() && z <= high_.z());
    }
    verdicts[i] = valid ? in_range ? Verdict::kept : Verdict::range : Verdict::nonfinite;
  }
}

void PointFilter::drop(const PointView& points, const RegionMask& mask, bool inside,
                       FilterScratch& scratch) const {
  mask.mark(points, scratch.inside, {Serial{}, isa_});
  for (std::size_t i = 0; i < points.count; ++i) {
    Verdict& verdict = scratch.verdicts[i];
    if (verdict == Verdict::kept && (scratch.inside[i] != 0) == inside) verdict = Verdict::inside;
  }
}

void PointFilter::judge(const PointView& points, FilterScratch& scratch) const {
  scratch.verdicts.resize(points.count);
  if (points.scalar == ScalarType::float64) {
    judge_distances<double>(points, scratch.verdicts);
  } else {
    judge_distances<float>(points, scratch.verdicts);
  }
  if (dropped_) drop(points, *dropped_, true, scratch);
  if (cropped_) drop(points, *cropped_, false, scratch);
}

void count_verdicts(const std::vector<Verdict>& verdicts, Counts& counts) {
  std::size_t of[4] = {};
  for (const Verdict verdict : verdicts)
    ++of[static_cast<std::size_t>(verdict)];
  counts.nonfinite += of[static_cast<std::size_t>(Verdict::nonfinite)];
  counts.range += of[static_cast<std::size_t>(Verdict::range)];
  counts.inside += of[static_cast<std::size_t>(Verdict::inside)];
}

void filter_points(const PointView& points, const PointFilter& filter, std::vector<std::int32_t>& kept,
                   FilterScratch& scratch, Counts& counts) {
  if (points.count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw std::length_error("more than 2147483647 points: too many to select from");
  kept.resize(points.count);
  std::size_t n = 0;
  for (std::size_t first = 0; first < points.count; first += kChunkPoints) {
    const PointView part = points.slice(first, std::min(kChunkPoints, points.count - first));
    filter.judge(part, scratch);
    count_verdicts(scratch.verdicts, counts);
    for (std::size_t i = 0; i < part.count; ++i) {
      kept[n] = static_cast<std::int32_t>(part.index(i));
      n += scratch.verdicts[i] == Verdict::kept;
    }
  }
  kept.resize(n);
}

}  // namespace pcl_bv
