// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ground_parts.h"

#include <new>
#include <utility>

#include "commands/shared/interruption.h"
#include "commands/shared/messages.h"
#include "object_texts.h"
#include "pcl_bv/report/ground_file.h"
#include "pipeline/ground.h"
#include "shares.h"
#include "tile_progress.h"

namespace pcl_bv::detail {

void write_ground_part(const Tiles& tiles, const ShareOption& share, const Options& options,
                       const std::filesystem::path& path, FileLife life) {
  const PointRange range = tiles.share(share.number, share.count);
  const SharePoints points(tiles, range, options.origin.at, options);
  GroundFileHeader header{describe_cloud(tiles, options.origin.at, options),
                          ground_text(options.pipeline.ground)};
  if (range.first < range.second) header.cloud.shares = {range};
  LowestPoints lowest(slope_settings(options.pipeline.ground));
  lowest.add(points.view(), execution_of(options).parallel);
  tiles.require_unchanged();
  write_ground_file(path, life, header, lowest);
}

CloudGround read_ground_parts(const Tiles& tiles, const Options& options,
                              const std::vector<std::string>& files) {
  LowestPoints lowest(slope_settings(options.pipeline.ground));
  PartialFile cloud = describe_cloud(tiles, options.origin.at, options);
  const std::string text = ground_text(options.pipeline.ground);
  for (const std::string& file : files) {
    try {
      const GroundFileHeader header = read_ground_file(file, lowest);
      if (header.options != text)
        throw IoError("was made with " + header.options + ": give the same options");
      cloud.merge(header.cloud);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      throw IoError(file + ": " + error.what());
    }
  }
  if (!cloud.is_whole()) throw IoError("--ground-parts: shares are missing: " + cloud.missing());
  const std::uint64_t check_sum = lowest.check_sum();
  return {SlopeSurface(std::move(lowest), execution_of(options)), check_sum};
}

CloudGround read_ground_parts(const Tiles& tiles, const Options& options) {
  std::vector<std::string> files;
  for (const Job& job : list_partials(options.ground_parts->string())) {
    if (job.error) throw IoError(job.input + ": " + *job.error);
    files.push_back(job.input);
  }
  return read_ground_parts(tiles, options, files);
}

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

}  // namespace pcl_bv::detail
