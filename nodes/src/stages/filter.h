// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The first look at a cloud: which points are kept.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "pcl_bv/kernels/point_view.h"
#include "pcl_bv/nodes/pipeline_config.h"
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
  void select(const PointView& points, std::vector<std::int32_t>& kept, FilterScratch& scratch,
              Counts& counts) const;

 private:
  template <typename T, typename Take>
  void each_distance(const PointView& points, const Take& take) const;
  template <typename Take>
  void each_distance(const PointView& points, const Take& take) const;
  void drop(const PointView& points, const RegionMask& mask, bool inside, FilterScratch& scratch) const;

  double min2_, max2_;
  bool boxed_;
  Eigen::Vector3d low_, high_;  // of the own vehicle
  std::unique_ptr<const RegionMask> dropped_, cropped_;
  UsableIsa isa_;
};

/// Adds up the reasons.
void count_verdicts(const std::vector<Verdict>& verdicts, Counts& counts);

}  // namespace pcl_bv
