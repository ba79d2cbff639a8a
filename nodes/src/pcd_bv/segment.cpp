// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// From a cloud to the sets of points that volumes are fitted around.

#include "segment.h"

#include <utility>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/picture.h"
#include "pcl_bv/segmentation/ground_zones.h"

namespace pcl_bv {
namespace {

PointView subset(PointView cloud, const std::vector<std::int32_t>& numbers) {
  cloud.indices = numbers.data();
  cloud.count = numbers.size();
  return cloud;
}

/// Fills in_range and counts. A float's square is exact in double and the sum of three is rounded twice,
/// so a point is judged by its true distance to within 2e-16 of it.
void filter(const PointView& cloud, const RangeFilter& range, Segmentation& result) {
  if (cloud.count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw IoError("more than 2147483647 points: too many to select from");
  }
  const double min2 = range.min * range.min, max2 = range.max * range.max;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const Coordinates p = load_point(cloud, i);
    if (!is_valid(p)) {
      ++result.counts.nonfinite;
      continue;
    }
    const double distance2 = p.x * p.x + p.y * p.y + p.z * p.z;
    if (distance2 >= min2 && distance2 <= max2) {
      result.in_range_numbers.push_back(static_cast<std::int32_t>(i));
    } else {
      ++result.counts.range;
    }
  }
  if (result.counts.range > 0) result.in_range = subset(cloud, result.in_range_numbers);
}

/// Fills ground, points and the count.
void remove_ground(const PointView& cloud, const GroundOptions& options, Segmentation& result) {
  GroundSplit split;
  if (options.kind == GroundKind::plane) {
    GroundPlaneSettings settings;
    settings.up = options.up;
    settings.sensor_height = options.sensor_height;
    split_ground(result.in_range, settings, split);
  } else {
    GroundZonesSettings settings;
    settings.up = options.up;
    settings.sensor_height = options.sensor_height;
    GroundZones().split(result.in_range, settings, split);
  }
  result.counts.ground = split.ground.size();
  result.ground = std::move(split.ground);
  result.above_ground = std::move(split.rest);
  result.points = subset(cloud, result.above_ground);
}

}  // namespace

Segmentation segment(const PointView& cloud, const Options& options) {
  Segmentation result;
  result.in_range = cloud;
  if (looks_at_points(options)) filter(cloud, options.range.value_or(RangeFilter{}), result);
  result.points = result.in_range;
  if (options.ground) remove_ground(cloud, *options.ground, result);
  if (!options.tolerance) {
    result.entries.push_back(result.points);
    return result;
  }
  EuclideanClusterer().extract(result.points, {*options.tolerance, options.min_size, options.max_size},
                               result.clusters);
  result.counts.small = result.clusters.small_points;
  result.counts.large = result.clusters.large_points;
  for (std::size_t id = 0; id < result.clusters.size(); ++id) {
    PointView& entry = result.entries.emplace_back(cloud);
    entry.indices = result.clusters.cluster(id);
    entry.count = result.clusters.cluster_size(id);
  }
  return result;
}

bool looks_at_points(const Options& options) {
  return options.range || options.ground || options.tolerance;
}

std::vector<std::uint32_t> labels(const Segmentation& segmentation, std::size_t cloud_size) {
  std::vector<std::uint32_t> label(cloud_size, label_none);
  for (const std::int32_t i : segmentation.ground)
    label[static_cast<std::size_t>(i)] = label_ground;
  for (std::size_t id = 0; id < segmentation.entries.size(); ++id) {
    const PointView& entry = segmentation.entries[id];
    for (std::size_t i = 0; i < entry.count; ++i) {
      if (is_valid(load_point(entry, i))) label[entry.index(i)] = static_cast<std::uint32_t>(id);
    }
  }
  return label;
}

}  // namespace pcl_bv
