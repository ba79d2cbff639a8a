// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "share_points.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "pipeline/config/settings.h"
#include "shifted_points.h"

namespace pcl_bv::detail {
namespace {

std::uint64_t hash_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  PartialFile hash;
  hash.add_input(std::string(std::istreambuf_iterator<char>(file), {}), 0);
  return hash.inputs_hash;
}

// Returns a text of the filter settings, which is equal for shares that drop the same points. It has the
// content of region files, but not their names.
std::string filter_text(const FilterConfig& filter) {
  std::string text = to_text(filter.range_min) + ':' + to_text(filter.range_max);
  if (filter.own_box_min)
    text += " own box " + to_text(*filter.own_box_min) + ' ' + to_text(*filter.own_box_max);
  for (const RegionConfig& region : filter.regions) {
    text += region.keep ? " keep " : " drop ";
    text += std::to_string(hash_of_file(region.file)) + '+' + to_text(region.padding);
  }
  return text;
}

std::string name_without_folders(const Job& job) {
  return std::filesystem::path(job.input).filename().string();
}

}  // namespace

Execution execution_of(const Options& options) {
  return options.pipeline.execution();
}

SharePoints::SharePoints(const Tiles& tiles, const PointRange& range,
                         const std::optional<Eigen::Vector3d>& origin, const Options& options) {
  PointView points = tiles.xyz();
  if (origin) {
    shifted_ = std::make_unique<ShiftedPoints>(points, *origin);
    points = view_of(*shifted_, points.count, ScalarType::float64);
  }
  points = points.slice(range.first, range.second - range.first);
  filtered_ = filter_points(points, options.pipeline.filter, execution_of(options), recorded_origin(origin));
}

PartialFile describe_cloud(const Tiles& tiles, const std::optional<Eigen::Vector3d>& origin,
                           const Options& options) {
  PartialFile file;
  for (std::size_t i = 0; i < tiles.jobs().size(); ++i) {
    if (!tiles.header(i).error) file.add_input(name_without_folders(tiles.jobs()[i]), tiles.header(i).points);
  }
  file.origin = origin;
  file.filter = filter_text(options.pipeline.filter);
  return file;
}

}  // namespace pcl_bv::detail
