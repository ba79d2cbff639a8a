// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ground_parts.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <new>
#include <utility>

#include "object_texts.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/report/ground_file.h"
#include "pipeline/ground.h"
#include "share_points.h"

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

namespace {

// Calls work(), and adds the name of the file to its errors.
template <typename Work>
void with_file(const std::string& file, const Work& work) {
  try {
    work();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw IoError(file + ": " + reason_of(error));
  }
}

using GroundFiles = std::vector<std::unique_ptr<GroundFile>>;

// Returns the range of the cells of a share: it has no points but those of the files that have its numbers.
CellRange cells_of_share(const GroundFiles& files, const PointRange& share) {
  CellRange cells;
  for (const auto& file : files)
    for (const auto& [first, end] : file->header().cloud.shares)
      if (first < share.second && share.first < end) cells.merge(file->bounds().cells);
  return cells;
}

CellRange cells_for_share(const GroundFiles& files, const PointRange& share,
                          const GroundSlopeOptions& options) {
  const CellRange own = cells_of_share(files, share);
  double highest = -std::numeric_limits<double>::infinity();
  for (const auto& file : files)
    if (file->bounds().cells.intersects(own.inflated(kBoundMargin)))
      highest = std::max(highest, file->bounds().highest);
  CellRange all;
  for (const auto& file : files) {  // the low points of a file that is too far away do not matter
    const CellRange cells = cells_that_matter(own, file->bounds().lowest, highest, options);
    if (cells.intersects(file->bounds().cells)) all.merge(cells);
  }
  return all;
}

}  // namespace

CloudGround read_ground_parts(const Tiles& tiles, const ShareOption& share, const Options& options,
                              const std::vector<std::string>& names) {
  PartialFile cloud = describe_cloud(tiles, options.origin.at, options);
  const std::string text = ground_text(options.pipeline.ground);
  GroundFiles files;
  std::uint64_t check_sum = 0;
  for (const std::string& name : names) {
    with_file(name, [&] {
      files.push_back(std::make_unique<GroundFile>(name));
      const GroundFileHeader& header = files.back()->header();
      if (header.options != text)
        throw IoError("was made with " + header.options + ": give the same options");
      cloud.merge(header.cloud);
      check_sum += files.back()->check_sum();
    });
  }
  if (!cloud.is_whole()) throw IoError("--ground-parts: shares are missing: " + cloud.missing());
  const GroundSlopeOptions slope = slope_settings(options.pipeline.ground);
  const CellRange cells = cells_for_share(files, tiles.share(share.number, share.count), slope);
  LowestPoints lowest(slope);
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!files[i]->bounds().cells.intersects(cells)) continue;
    with_file(names[i], [&] { files[i]->read(cells, lowest); });
  }
  return {SlopeSurface(std::move(lowest), execution_of(options)), check_sum};
}

CloudGround read_ground_parts(const Tiles& tiles, const ShareOption& share, const Options& options) {
  std::vector<std::string> files;
  for (const Job& job : list_partials(options.ground_parts->string())) {
    if (job.error) throw IoError(job.input + ": " + *job.error);
    files.push_back(job.input);
  }
  return read_ground_parts(tiles, share, options, files);
}

}  // namespace pcl_bv::detail
