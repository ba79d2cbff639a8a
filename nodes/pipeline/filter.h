// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The filter stage, which selects the points that enter the pipeline.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/parallel/parts.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/segmentation/clusters.h"
#include "pcl_bv/trees/region_mask.h"

namespace pcl_bv::detail {

/// Whether a point is kept, or the reason why it is dropped. `range` means that the distance is out of range
/// or that the point is in the box of the own vehicle. `region` means that the point is inside a region to
/// drop, or outside all regions to keep.
enum class Verdict : std::uint8_t { kept, nonfinite, range, region };

/// Memory that calls of PointFilter::classify() reuse.
struct FilterScratch {
  std::vector<Verdict> verdicts;
  std::vector<std::uint8_t> inside;
};

/// The part of the points that one thread filters.
struct FilterPart {
  std::size_t begin, end;  ///< Range of point numbers in the view.
  std::size_t kept;
  Counts counts;
  FilterScratch scratch;
};

/// A configured filter. Const member functions may be called concurrently.
class PointFilter {
 public:
  /// Reads the files of regions that have no volumes. Throws IoError if a file cannot be read.
  PointFilter(const FilterConfig& config, UsableIsa isa);

  /// Returns a filter for a cloud whose origin was moved to `origin`: distances are measured from there, and
  /// the box of the own vehicle is moved by it.
  PointFilter with_origin(const Eigen::Vector3d& origin) const;

  /// Returns whether all finite points are kept.
  bool keeps_all() const;

  /// Returns boxes around the volumes of the regions to keep; nullopt if points need not be in a region.
  /// Points outside all boxes are dropped.
  std::optional<std::vector<Aabb>> kept_extents() const;

  /// Computes the verdict of each point. The points must be in memory. Distances are measured from the origin
  /// or, in a merged cloud, from the sensor that measured the point. For float32 and the origin, the relative
  /// error of a distance is below 2e-16: the square of a float is exact in double, and only the two additions
  /// of the three squares are rounded.
  void classify(const PointView& points, const std::vector<SensorPart>& sensors,
                FilterScratch& scratch) const;

  /// Replaces `kept` by the numbers of the points that are kept, in the order of the view. Counts the dropped
  /// points by reason in `counts`. Throws std::length_error for more than 2^31 - 1 points.
  void select(const PointView& points, const std::vector<SensorPart>& sensors, const ParallelPolicy& policy,
              std::vector<std::int32_t>& kept, PointParts<FilterPart>& parts, Counts& counts) const;

 private:
  template <typename T, bool from_origin, typename Take>
  void each_distance(const PointView& points, std::size_t begin, std::size_t end, const Eigen::Vector3d& from,
                     const Take& take) const;
  template <typename Take>
  void each_distance(const PointView& points, const std::vector<SensorPart>& sensors, const Take& take) const;
  void select(const PointView& points, const std::vector<SensorPart>& sensors, std::int32_t* kept,
              FilterPart& part) const;
  void drop(const PointView& points, const RegionMask& mask, bool inside, FilterScratch& scratch) const;

  double min2_, max2_;
  bool has_own_box_;
  Eigen::Vector3d low_, high_;  // box of the own vehicle
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::optional<RegionMask> dropped_, cropped_;
  UsableIsa isa_;
};

/// Adds the number of points with each verdict to `counts`.
void count_verdicts(const std::vector<Verdict>& verdicts, Counts& counts);

/// The filtered points of a view that is too large for index lists. Dropped points become NaN.
class FilteredPoints final : public PointSource {
 public:
  /// Stores the view, which must not have an index list, and the owner of its points.
  FilteredPoints(const PointView& points, std::shared_ptr<const void> owner,
                 std::shared_ptr<const PointFilter> filter, std::vector<SensorPart> sensors = {})
      : points_(points), owner_(std::move(owner)), filter_(std::move(filter)), sensors_(std::move(sensors)) {}

  /// Counts the dropped points by reason, in one pass over all points.
  Counts count(const ParallelPolicy& policy) const;

  /// Returns the filtered points of a range. The loaded points keep their numbers in the view.
  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override;

 private:
  PointView points_;
  std::shared_ptr<const void> owner_;
  std::shared_ptr<const PointFilter> filter_;
  std::vector<SensorPart> sensors_;
};

}  // namespace pcl_bv::detail
