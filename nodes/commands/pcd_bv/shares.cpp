// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "shares.h"

#include <new>
#include <stdexcept>

#include "commands/shared/interruption.h"
#include "commands/shared/messages.h"
#include "ground_parts.h"
#include "object_shares.h"
#include "pcl_bv/io/untrusted_text.h"
#include "shifted_points.h"
#include "tile_progress.h"

namespace pcl_bv {
using namespace detail;

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
      report_problem(name + ": " + reason_of(error));
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

void detail::set_left_out(const Tiles& tiles, Report& report) {
  for (std::size_t i = 0; i < tiles.jobs().size(); ++i)
    if (const auto& error = tiles.header(i).error) report.left_out.push_back({tiles.jobs()[i].input, *error});
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

// Writes the file of --partial with the ground of a share. Reports problems.
Status make_ground_part(const Job& job, const Options& options) {
  const Interruption interruption([] {});
  if (report_excluded_inputs(*job.tiles) != Status::done) return Status::failed;
  const TileProgress progress(*job.tiles, options);
  try {
    write_ground_part(*job.tiles, options.share, options, *options.partial, FileLife::lasting);
    report_notes(*job.tiles);
    return Status::done;
  } catch (const TileError& error) {
    report_problem(job.tiles->jobs()[error.tile()].input + ": " + error.what());
  } catch (const IoError& error) {
    report_problem(options.partial->string() + ": " + error.what());
  }
  return Status::failed;
}

// Reports the file that cannot be used; then returns nothing.
std::optional<CloudGround> ground_of_parts(const Tiles& tiles, const Options& options) {
  if (!options.ground_parts) return std::nullopt;
  try {
    return read_ground_parts(tiles, options.share, options);
  } catch (const IoError& error) {
    report_problem(error.what());
    return std::nullopt;
  }
}

// Finds the clusters of the share that the options name, fits their volumes and writes the file of --partial.
// Or, with --merge, writes all files to one. Reports problems on standard error.
Status make_object_file(const Job& job, const Options& options) {
  const Interruption interruption([] {});
  try {
    if (!job.partials.empty())
      return join_object_files(job.partials, options) ? Status::done : Status::failed;
    if (report_excluded_inputs(*job.tiles) != Status::done) return Status::failed;
    const TileProgress progress(*job.tiles, options);
    const std::optional<CloudGround> ground = ground_of_parts(*job.tiles, options);
    if (options.ground_parts && !ground) return Status::failed;
    write_object_share(*job.tiles, options.share, options, ground, *options.partial);
    report_notes(*job.tiles);
    return Status::done;
  } catch (const TileError& error) {
    report_problem(job.tiles->jobs()[error.tile()].input + ": " + error.what());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    report_problem(options.partial->string() + ": " + reason_of(error));
  }
  return Status::failed;
}

}  // namespace

Status detail::make_partial_file(const Job& job, const Options& options) {
  if (job.partials.empty()) {  // with --merge, points were filtered before
    const std::string moved = origin_warning(options.origin.at, false, options);
    if (!moved.empty()) report_problem(moved);
  }
  if (options.clusters()) return make_object_file(job, options);
  if (options.writes_ground_part()) return make_ground_part(job, options);
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
