// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The command line of pcd_bv, which is checked completely before any work begins.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/report/picture.h"

namespace pcl_bv::detail {

enum class OutputFormat {
  text,
  json,
  jsonl,
  csv,
  kitti,
  kitti_tracking,
  nuscenes,
  openlabel,
  sustech,
  tiles,
  tile_regions
};

/// The origin that is subtracted from all coordinates before processing.
struct OriginOption {
  bool requested = false;
  std::optional<Eigen::Vector3d> at{};  ///< If not given: rounded_centre() of each cloud.
};

/// One of `count` shares of a cloud; the first share has number 0.
struct ShareOption {
  std::size_t number = 0;
  std::size_t count = 1;
};

struct Options {
  std::vector<std::string> inputs;
  std::size_t bin_fields = 0;  ///< Floats per point of .bin files, as in read_cloud().
  std::string columns;         ///< Columns of text files, as in read_cloud().
  std::string topic;           ///< Topic of recordings.
  OriginOption origin;
  PipelineConfig pipeline;
  std::string range_from;   ///< Where the range was set, see SettingOptions::config().
  std::string config_file;  ///< File of --config; empty without it.
  OutputFormat format = OutputFormat::text;
  std::string object_type;  ///< Type of all objects in box labels; empty without --object-type.
  std::optional<std::filesystem::path> output, labels, mesh, image, view_html, objects;
  ViewFrom view = ViewFrom::iso;
  bool tiled = false;  ///< Whether all inputs are one cloud (--together, --partial).
  bool merge = false;  ///< Whether inputs are files of partial results.
  std::optional<std::filesystem::path> partial;  ///< File for partial results instead of volumes.
  std::optional<std::filesystem::path> ground_parts;  ///< File or folder with the ground of all shares.
  ShareOption share;                             ///< The share of points that the partial results cover.
  std::string gpu;                               ///< Value of --gpu; empty without it.
  std::size_t memory_bytes = 600'000'000;        ///< For clustering a tiled cloud.
  bool threads_given = false;                    ///< Whether --threads was given.
  bool update = false;                           ///< Whether inputs are tilesets to be updated.
  bool watch = false;  ///< Whether the input is a folder whose new files are inputs.
  bool check = false;
  bool info = false;
  bool timings = false;
  bool progress = false;

  bool clusters() const { return pipeline.cluster.tolerance > 0; }
  bool slope_ground() const { return pipeline.ground.method == GroundMethod::slope; }
  /// Whether the file of --partial has the ground of a share, for --ground-parts.
  bool writes_ground_part() const { return partial && !merge && !clusters() && slope_ground(); }
};

/// Returns whether a file of this format has the results of only one input.
inline bool has_one_input(OutputFormat format) {
  return format == OutputFormat::kitti || format == OutputFormat::sustech || format == OutputFormat::tiles ||
         format == OutputFormat::tile_regions;
}

/// Returns whether files other than the report are requested.
inline bool writes_files(const Options& options) {
  return options.labels || options.mesh || options.image || options.view_html || options.objects;
}

/// The commands that use parse_options().
enum class PcdBvCommand {
  serial,
  mpi  ///< pcd_bv_mpi, which has no options for files of partial results.
};

/// Parses the command line and returns the options. For --help, --version and --print-config, returns a text
/// for standard output instead. Throws UsageError.
std::variant<Options, std::string> parse_options(int argc, const char* const* argv,
                                                 PcdBvCommand command = PcdBvCommand::serial);

}  // namespace pcl_bv::detail
