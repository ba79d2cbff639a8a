// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "filter.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "filtered_view.h"
#include "kept_points.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/report/read_volumes.h"

namespace pcl_bv::detail {
namespace {

std::optional<RegionMask> mask_of(const std::vector<RegionConfig>& regions, bool keep) {
  std::vector<Region> inflated;
  bool any = false;
  for (const RegionConfig& region : regions) {
    if (region.keep != keep) continue;
    any = true;
    for (const AnyVolume& volume : region.volumes.empty() ? read_volumes(region.file) : region.volumes)
      inflated.push_back({volume, region.padding});
  }
  if (!any) return std::nullopt;
  return RegionMask(inflated);
}

void add(const Counts& part, Counts& all) {
  all.nonfinite += part.nonfinite;
  all.range += part.range;
  all.inside += part.inside;
}

}  // namespace

PointFilter::PointFilter(const FilterConfig& config, UsableIsa isa)
    : min2_(config.range_min * config.range_min),
      max2_(config.range_max * config.range_max),
      has_own_box_(config.own_box_min.has_value()),
      low_(config.own_box_min.value_or(Eigen::Vector3d::Zero())),
      high_(config.own_box_max.value_or(Eigen::Vector3d::Zero())),
      dropped_(mask_of(config.regions, false)),
      cropped_(mask_of(config.regions, true)),
      isa_(isa) {}

PointFilter PointFilter::with_origin(const Eigen::Vector3d& origin) const {
  PointFilter moved = *this;
  moved.origin_ += origin;
  moved.low_ += origin;
  moved.high_ += origin;
  return moved;
}

bool PointFilter::keeps_all() const {
  return min2_ == 0 && max2_ == std::numeric_limits<double>::infinity() && !has_own_box_ && !dropped_ &&
         !cropped_;
}

std::optional<std::vector<Aabb>> PointFilter::kept_extents() const {
  if (!cropped_) return std::nullopt;
  return cropped_->extents();
}

// Calls take(i, valid, kept) for each point. `kept` depends on the distance and the box of the own vehicle,
// not on regions. The loop compares distances without a branch.
template <typename T, bool from_origin, typename Take>
void PointFilter::each_distance(const PointView& points, std::size_t begin, std::size_t end,
                                const Eigen::Vector3d& from, const Take& take) const {
  const double min2 = min2_, max2 = max2_;  // copies, because members would be read again after each store
  const double from_x = from.x(), from_y = from.y(), from_z = from.z();
  for (std::size_t i = begin; i < end; ++i) {
    T p[3];
    load_point(points, i, p);
    const double x = p[0], y = p[1], z = p[2];
    const double dx = from_origin ? x : x - from_x, dy = from_origin ? y : y - from_y,
                 dz = from_origin ? z : z - from_z;
    const double distance2 = (dx * dx + dy * dy) + dz * dz;
    // The squares of finite floats are finite in double, so one comparison replaces three.
    const bool valid =
        sizeof(T) == 4 ? distance2 < std::numeric_limits<double>::infinity() : is_valid({x, y, z});
    // A branch would be mispredicted, because beams without a return come at random.
    bool in_range = (distance2 >= min2) & (distance2 <= max2);
    if (has_own_box_) {
      in_range = in_range && !(x >= low_.x() && x <= high_.x() && y >= low_.y() && y <= high_.y() &&
                               z >= low_.z() && z <= high_.z());
    }
    take(i, valid, valid & in_range);
  }
}

template <typename Take>
void PointFilter::each_distance(const PointView& points, const std::vector<SensorPart>& sensors,
                                const Take& take) const {
  const bool doubles = points.scalar == ScalarType::float64;
  if (sensors.empty() && origin_.isZero(0)) {
    return doubles ? each_distance<double, true>(points, 0, points.count, origin_, take)
                   : each_distance<float, true>(points, 0, points.count, origin_, take);
  }
  if (sensors.empty()) {
    return doubles ? each_distance<double, false>(points, 0, points.count, origin_, take)
                   : each_distance<float, false>(points, 0, points.count, origin_, take);
  }
  // A merged cloud has no index list, so `points` are those from points.first on.
  for (const SensorPart& sensor : sensors) {
    const auto position = [&](std::size_t number) {
      return std::clamp(number, points.first, points.first + points.count) - points.first;
    };
    const std::size_t begin = position(sensor.first), end = position(sensor.first + sensor.count);
    doubles ? each_distance<double, false>(points, begin, end, sensor.position, take)
            : each_distance<float, false>(points, begin, end, sensor.position, take);
  }
}

void PointFilter::drop(const PointView& points, const RegionMask& mask, bool inside,
                       FilterScratch& scratch) const {
  mask.mark(points, scratch.inside, {Serial{}, isa_});
  for (std::size_t i = 0; i < points.count; ++i) {
    Verdict& verdict = scratch.verdicts[i];
    if (verdict == Verdict::kept && (scratch.inside[i] != 0) == inside) verdict = Verdict::region;
  }
}

void PointFilter::classify(const PointView& points, const std::vector<SensorPart>& sensors,
                           FilterScratch& scratch) const {
  scratch.verdicts.resize(points.count);
  each_distance(points, sensors, [&](std::size_t i, bool valid, bool kept) {
    scratch.verdicts[i] = kept ? Verdict::kept : valid ? Verdict::range : Verdict::nonfinite;
  });
  if (dropped_) drop(points, *dropped_, true, scratch);
  if (cropped_) drop(points, *cropped_, false, scratch);
}

void count_verdicts(const std::vector<Verdict>& verdicts, Counts& counts) {
  std::size_t of[4] = {};
  for (const Verdict verdict : verdicts)
    ++of[static_cast<std::size_t>(verdict)];
  counts.nonfinite += of[static_cast<std::size_t>(Verdict::nonfinite)];
  counts.range += of[static_cast<std::size_t>(Verdict::range)];
  counts.inside += of[static_cast<std::size_t>(Verdict::region)];
}

void PointFilter::select(const PointView& points, const std::vector<SensorPart>& sensors, std::int32_t* kept,
                         FilterPart& part) const {
  std::size_t n = 0;
  const auto take = [&](std::size_t i, bool keep) {
    kept[n] = static_cast<std::int32_t>(points.index(i));
    n += keep;
  };
  part.counts = {};
  if (dropped_ || cropped_) {
    classify(points, sensors, part.scratch);
    count_verdicts(part.scratch.verdicts, part.counts);
    for (std::size_t i = 0; i < points.count; ++i)
      take(i, part.scratch.verdicts[i] == Verdict::kept);
  } else {
    std::size_t invalid = 0;
    each_distance(points, sensors, [&](std::size_t i, bool valid, bool keep) {
      invalid += !valid;
      take(i, keep);
    });
    part.counts.nonfinite = invalid;
    part.counts.range = points.count - invalid - n;
  }
  part.kept = n;
}

void PointFilter::select(const PointView& points, const std::vector<SensorPart>& sensors,
                         const ParallelPolicy& policy, std::vector<std::int32_t>& kept,
                         PointParts<FilterPart>& parts, Counts& counts) const {
  if (points.count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw std::length_error("more than 2147483647 points: too many to select from");
  kept.resize(points.count);
  parts.cut(points.count, policy);
  parts.for_each(policy, [&](FilterPart& part) {
    select(points.slice(part.begin, part.end - part.begin), sensors, kept.data() + part.begin, part);
  });
  std::int32_t* to = kept.data();
  for (const FilterPart& part : parts) {
    const std::int32_t* const from = kept.data() + part.begin;
    to = to == from ? to + part.kept : std::copy_n(from, part.kept, to);
    add(part.counts, counts);
  }
  kept.resize(static_cast<std::size_t>(to - kept.data()));
}

Counts FilteredPoints::count(const ParallelPolicy& policy) const {
  const auto count_chunk = [&](std::size_t chunk) {
    FilterScratch scratch;
    filter_->classify(load_chunk(points_, chunk).view(), sensors_, scratch);
    Counts counts;
    count_verdicts(scratch.verdicts, counts);
    return counts;
  };
  return reduce_chunks(policy, chunk_count(points_.count), Counts{}, count_chunk,
                       [](Counts& all, const Counts& part) { add(part, all); });
}

PointView FilteredPoints::load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const {
  const LoadedPoints part(points_, first - points_.first, count);
  FilterScratch scratch;
  filter_->classify(part.view(), sensors_, scratch);
  return kept_points(
      part.view(), first, [&](std::size_t i) { return scratch.verdicts[i] == Verdict::kept; }, buffer);
}

FilteredView filter_points(const PointView& points, const FilterConfig& config, const Execution& execution,
                           const Eigen::Vector3d& origin) {
  if (points.indices != nullptr) throw std::invalid_argument("filter_points: the view has an index list");
  const auto filter =
      std::make_shared<const PointFilter>(PointFilter(config, execution.isa).with_origin(origin));
  if (filter->keeps_all()) return {points, {}, {}};
  const auto filtered = std::make_shared<const FilteredPoints>(points, nullptr, filter);
  FilteredView view{view_of(*filtered, points.count, points.scalar), filtered->count(execution.parallel),
                    filtered};
  view.points.first = points.first;
  return view;
}

}  // namespace pcl_bv::detail
