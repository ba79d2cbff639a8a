// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The clouds that the command line names, and the output files of each cloud.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "options.h"
#include "pcl_bv/io/las.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/parallel/execution.h"
#include "stream/sources/recorded_clouds.h"

namespace pcl_bv::detail {

class Tiles;

/// One cloud to be processed.
struct Job {
  std::string input;                   ///< A file, synth:NAME[:POINTS[:SEED]], or RECORDING#NUMBER.
  std::optional<std::string> error{};  ///< Why nothing can be loaded, such as "no cloud in this recording".
  std::optional<std::filesystem::path> labels{}, mesh{}, image{}, view_html{};
  std::optional<std::filesystem::path> objects{};  ///< Folder for the points of each object.
  std::set<std::filesystem::path> folders{};       ///< Folders that options name, to be created.
  std::size_t bin_fields = 0;                      ///< Floats per point of .bin files, as in read_cloud().
  std::string columns{};                           ///< Columns of text files, as in read_cloud().
  std::shared_ptr<RecordedClouds> recording{};     ///< Recording of cloud `number`; `input` is FILE#number.
  std::size_t number = 0;
  std::optional<std::size_t> frame{};  ///< Number among the inputs, from 0, if there are several.
  std::shared_ptr<Tiles> tiles{};      ///< Set for a tiled cloud (--together); `input` is kTiledName.
  std::vector<std::filesystem::path> tile_labels{};  ///< Files with labels of the tiles, if requested.
  std::vector<std::string> partials{};               ///< Files of partial results (--merge).
};

/// The name, in results, of a cloud that is tiled over several inputs or merged from partial results.
inline constexpr char kTiledName[] = "together";

/// Returns whether an input is a generated cloud, not a file.
bool is_synth(const std::string& input);

/// Returns all inputs as jobs without output files. Folders are expanded in natural order.
std::vector<Job> list_inputs(const Options& options);

/// Returns a tiled cloud of the inputs, whose headers are read.
std::shared_ptr<Tiles> open_tiles(std::vector<Job> inputs, const ParallelPolicy& policy);

/// Returns the jobs with their output files. There is one job for each input, or one job for all inputs
/// (--together, --merge). A tiled cloud consists of `tiles`. If `tiles` is null, the headers of the inputs
/// are read to create the tiles. Throws UsageError if two results would go to the same file or an input would
/// be overwritten.
std::vector<Job> plan_jobs(const Options& options, std::vector<Job> inputs,
                           std::shared_ptr<Tiles> tiles = nullptr);
inline std::vector<Job> plan_jobs(const Options& options) {
  return plan_jobs(options, list_inputs(options));
}

/// Returns the argument or, if it is a folder, all files in it that are not hidden, ordered by name. If there
/// is none, the job has an error.
std::vector<Job> list_partials(const std::string& argument);

/// Returns the file in a folder for the labels of an input.
std::filesystem::path label_file(const std::filesystem::path& folder, const std::string& input);

/// Loads the cloud of a job. Nodes of a COPC file that `can_skip` accepts are left out as in read_las().
/// Throws IoError if that fails, and std::invalid_argument for an unknown scene.
RawCloud load_cloud(const Job& job, const Execution& execution, const BoxPredicate& can_skip = {});

}  // namespace pcl_bv::detail
