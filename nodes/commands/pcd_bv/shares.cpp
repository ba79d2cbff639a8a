// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "shares.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <stdexcept>

#include "commands/shared/interruption.h"
#include "commands/shared/messages.h"
#include "object_shares.h"
#include "pipeline/config/settings.h"
#include "shifted_points.h"
#include "tile_progress.h"

namespace pcl_bv {
using namespace detail;
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

Execution detail::execution_of(const Options& options) {
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
  filtered_ = filter_points(points, options.pipeline.filter, execution_of(options));
}

PartialFile detail::describe_cloud(const Tiles& tiles, const std::optional<Eigen::Vector3d>& origin,
                                   const Options& options) {
  PartialFile file;
  for (std::size_t i = 0; i < tiles.jobs().size(); ++i) {
    if (!tiles.header(i).error) file.add_input(name_without_folders(tiles.jobs()[i]), tiles.header(i).points);
  }
  file.origin = origin;
  file.filter = filter_text(options.pipeline.filter);
  return file;
}

void detail::add_share(const SharePoints& points, const PointRange& range, const Execution& execution,
                       PartialFile& file) {
  if (range.first == range.second) return;
  file.shares = {range};
  file.counts = points.counts();
  file.counts.nonfinite = 0;  // set_volume() computes it from the invalid points
  file.partial = Partial(points.view(), 0, execution);
}

std::optional<MergedClouds> detail::merge_files(const std::vector<std::string>& files) {
  MergedClouds all;
  bool failed = false;
  for (const std::string& name : files) {
    try {
      const MergedClouds file = read_partial_file(name);
      for (const PartialFile& cloud : file.clouds())
        all.add(cloud);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      report_problem(name + ": " + error.what());
      failed = true;
    }
  }
  return failed ? std::nullopt : std::optional(std::move(all));
}

Report detail::report_of(const PartialFile& whole, const std::vector<const Method*>& methods) {
  Report report;
  report.file = kTiledName;
  report.parts = whole.inputs;
  report.points = whole.cloud_points;
  report.origin = whole.origin;
  report.counts = whole.counts;
  report.clusters.emplace_back();
  for (const Method* method : methods)
    report.clusters.front().volumes.emplace_back().method = method->name;
  return report;
}

void detail::set_volume(std::size_t index, const EstimationResult& result, AnyVolume volume, Report& report) {
  ClusterEntry& all = report.clusters.front();
  all.points = result.used;
  report.counts.nonfinite = result.dropped - report.counts.range - report.counts.inside;
  all.volumes[index].volume = std::move(volume);
  all.volumes[index].failed = result.reason;
}

Status detail::report_excluded_inputs(const Tiles& tiles) {
  Status status = Status::done;
  for (std::size_t i = 0; i < tiles.jobs().size(); ++i) {
    if (!tiles.header(i).error) continue;
    report_problem(tiles.jobs()[i].input + ": " + *tiles.header(i).error);
    status = Status::failed;
  }
  return status;
}

void detail::report_notes(const Tiles& tiles) {
  for (std::size_t i = 0; i < tiles.jobs().size(); ++i) {
    const std::string note = tiles.note(i);
    if (!tiles.header(i).error && !note.empty()) report_problem(tiles.jobs()[i].input + ": " + note);
  }
}

namespace {

Status write_or_report(const std::filesystem::path& path, const MergedClouds& clouds) {
  try {
    write_partial_file(path, clouds);
    return Status::done;
  } catch (const IoError& error) {
    report_problem(path.string() + ": " + error.what());
    return Status::failed;
  }
}

}  // namespace

Status detail::make_partial_file(const Job& job, const Options& options) {
  if (options.clusters()) return make_object_file(job, options);
  const Interruption interruption([] {});
  if (!job.partials.empty()) {
    const std::optional<MergedClouds> merged = merge_files(job.partials);
    return merged ? write_or_report(*options.partial, *merged) : Status::failed;
  }
  // No input may be excluded: the other shares contain it, so they would belong to a different cloud.
  if (report_excluded_inputs(*job.tiles) != Status::done) return Status::failed;
  const TileProgress progress(*job.tiles, options);
  const Execution execution = execution_of(options);
  PartialFile file = describe_cloud(*job.tiles, options.origin.at, options);
  const PointRange range = job.tiles->share(options.share.number, options.share.count);
  try {
    const SharePoints points(*job.tiles, range, options.origin.at, options);
    add_share(points, range, execution, file);
    job.tiles->require_unchanged();
    report_notes(*job.tiles);
  } catch (const TileError& error) {
    report_problem(job.tiles->jobs()[error.tile()].input + ": " + error.what());
    return Status::failed;
  }
  MergedClouds clouds;
  clouds.add(file);
  return write_or_report(*options.partial, clouds);
}

}  // namespace pcl_bv
