// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// From a cloud to the sets of points that volumes are fitted around.

#include "segment.h"

#include <utility>

#include "pcl_bv/report/picture.h"
#include "stages/filter.h"
#include "stages/filtered_points.h"
#include "stages/ground.h"

namespace pcl_bv {
namespace {

PointView subset(PointView cloud, const std::vector<std::int32_t>& numbers) {
  cloud.indices = numbers.data();
  cloud.count = numbers.size();
  return cloud;
}

FilterConfig filter_of(const Options& options) {
  FilterConfig filter;
  filter.range_min = options.range ? options.range->min : 0;
  if (options.range) filter.range_max = options.range->max;
  return filter;
}

// Fills in_range and counts. A big cloud that is only filtered goes the same way, to the same bits, whether
// it is in memory or in a file: it is filtered as it comes past.
void filter(const PointView& cloud, const Options& options, Segmentation& result) {
  const FilterConfig config = filter_of(options);
  if (!tells_points_apart(options) && cloud.count > kChunkPoints) {
    auto filtered = std::make_unique<FilteredPoints>(cloud, config);
    result.counts = filtered->count(options.execution.parallel);
    if (result.counts.range > 0) result.in_range = filtered->view();
    result.filtered = std::move(filtered);
    return;
  }
  filter_points(cloud, config, result.in_range_numbers, result.counts);
  if (result.counts.range > 0) result.in_range = subset(cloud, result.in_range_numbers);
}

// Fills ground, points and the count.
void remove_ground(const PointView& cloud, const GroundOptions& options, Segmentation& result) {
  GroundConfig config;
  config.method = options.kind == GroundKind::plane ? GroundMethod::plane : GroundMethod::zones;
  config.up = options.up;
  config.sensor_height = options.sensor_height;
  GroundZones zones;
  GroundSplit split;
  split_ground(result.in_range, config, zones, split);
  result.counts.ground = split.ground.size();
  result.ground = std::move(split.ground);
  result.above_ground = std::move(split.rest);
  result.points = subset(cloud, result.above_ground);
}

}  // namespace

bool tells_points_apart(const Options& options) {
  return options.ground || options.tolerance;
}

Segmentation segment(const PointView& cloud, const Options& options) {
  Segmentation result;
  result.in_range = cloud;
  if (looks_at_points(options)) filter(cloud, options, result);
  result.points = result.in_range;
  if (options.ground) remove_ground(cloud, *options.ground, result);
  if (!options.tolerance) {
    result.entries.push_back(result.points);
    return result;
  }
  EuclideanClusterer().extract(result.points, {*options.tolerance, options.min_size, options.max_size},
                               result.clusters, options.execution.parallel);
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
  return options.range || tells_points_apart(options);
}

std::vector<std::uint32_t> labels(const Segmentation& segmentation, std::size_t cloud_size) {
  std::vector<std::uint32_t> label(cloud_size, label_none);
  for (const std::int32_t i : segmentation.ground)
    label[static_cast<std::size_t>(i)] = label_ground;
  for (std::size_t id = 0; id < segmentation.entries.size(); ++id) {
    const PointView& entry = segmentation.entries[id];
    for (std::size_t chunk = 0; chunk < chunk_count(entry.count); ++chunk) {
      const LoadedPoints loaded = load_chunk(entry, chunk);
      const PointView& part = loaded.view();
      for (std::size_t i = 0; i < part.count; ++i) {
        if (is_valid(load_point(part, i))) label[part.index(i)] = static_cast<std::uint32_t>(id);
      }
    }
  }
  return label;
}

}  // namespace pcl_bv
