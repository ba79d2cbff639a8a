// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/parallel/parts.h"
#include "pcl_bv/parallel/policy.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/segmentation/counts.h"
#include "pcl_bv/trees/region_mask.h"

namespace pcl_bv {

/// Why a point is dropped.
enum class Verdict : std::uint8_t { kept, nonfinite, range, inside };

/// Memory that calls share.
struct FilterScratch {
  std::vector<Verdict> verdicts;
  std::vector<std::uint8_t> inside;
};

/// Points that one thread takes.
struct FilterPart {
  std::size_t begin, end;  ///< In the view.
  std::size_t kept;
  Counts counts;
  FilterScratch scratch;
};

/// A configured filter. Const calls may run side by side.
class PointFilter {
 public:
  /// Reads the files of regions without volumes; throws IoError for one that cannot be read.
  PointFilter(const FilterConfig& config, UsableIsa isa);

  /// Whether all finite points are kept.
  bool keeps_all() const;

  /// Judges points in memory, one verdict each. The square of a float is exact in double and the sum of three
  /// is rounded twice: a point is judged by its true distance to within 2e-16 of it.
  void judge(const PointView& points, FilterScratch& scratch) const;

  /// Replaces `kept` with the numbers of the points of the view that are kept, in its order; counts the
  /// others. Throws std::length_error beyond 2^31 - 1 points.
  void select(const PointView& points, const ParallelPolicy& policy, std::vector<std::int32_t>& kept,
              Parts<FilterPart>& parts, Counts& counts) const;

 private:
  template <typename T, typename Take>
  void each_distance(const PointView& points, const Take& take) const;
  template <typename Take>
  void each_distance(const PointView& points, const Take& take) const;
  void select(const PointView& points, std::int32_t* kept, FilterPart& part) const;
  void drop(const PointView& points, const RegionMask& mask, bool inside, FilterScratch& scratch) const;

  double min2_, max2_;
  bool boxed_;
  Eigen::Vector3d low_, high_;  // of the own vehicle
  std::optional<RegionMask> dropped_, cropped_;
  UsableIsa isa_;
};

/// Adds up the reasons.
void count_verdicts(const std::vector<Verdict>& verdicts, Counts& counts);

/// The points of a view that is too big for lists; those that the filter drops are not valid (NaN).
class FilteredPoints final : public PointSource {
 public:
  /// Keeps the view, whose points are not of an index list, and their owner.
  FilteredPoints(const PointView& points, std::shared_ptr<const void> owner,
                 std::shared_ptr<const PointFilter> filter)
      : points_(points), owner_(std::move(owner)), filter_(std::move(filter)) {}

  /// What is dropped, by reason: a pass over all points.
  Counts count(const ParallelPolicy& policy) const;

  /// Points have the numbers that they have in the view.
  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override;

 private:
  PointView points_;
  std::shared_ptr<const void> owner_;
  std::shared_ptr<const PointFilter> filter_;
};

/// Points of a cloud in memory by their numbers, which are known to be right.
inline PointView subset(PointView cloud, const std::int32_t* numbers, std::size_t count) {
  // A slice counts from its cloud's first point, but begins elsewhere.
  const bool moved = cloud.indices == nullptr && cloud.order == PointOrder::records && cloud.data != nullptr;
  if (moved) cloud.data -= cloud.stride * cloud.first;
  cloud.first = 0;
  cloud.indices = numbers;
  cloud.count = count;
  return cloud;
}

inline PointView subset(const PointView& cloud, const std::vector<std::int32_t>& numbers) {
  return subset(cloud, numbers.data(), numbers.size());
}

}  // namespace pcl_bv
