// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The command line of pcd_bv, checked whole before any work begins.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/report/picture.h"

namespace pcl_bv {

enum class OutputFormat { text, json, jsonl, csv };

/// What is subtracted from all coordinates before anything else.
struct OriginOption {
  bool asked = false;
  std::optional<Eigen::Vector3d> at{};  ///< If not given: the middle of each cloud, in whole numbers.
};

/// One of `count` shares of a cloud, by its number from 0 on.
struct ShareOption {
  std::size_t number = 0;
  std::size_t count = 1;
};

struct Options {
  std::vector<std::string> inputs;
  std::size_t bin_fields = 0;  ///< As read_cloud() takes it.
  std::string topic;           ///< Of recordings.
  OriginOption origin;
  PipelineConfig pipeline;
  std::string range_from;   ///< As SettingOptions::config() says it.
  std::string config_file;  ///< Of --config, empty without it.
  OutputFormat format = OutputFormat::text;
  std::optional<std::filesystem::path> output, labels, mesh, image, view_html;
  ViewFrom view = ViewFrom::iso;
  bool together = false;  ///< All inputs are one cloud; also set by --partial without --merge.
  bool merge = false;     ///< Inputs are files of partial results.
  std::optional<std::filesystem::path> partial;  ///< Write partial results there, and no volumes.
  ShareOption share;                             ///< Of which of the cloud's points they are.
  bool threads_given = false;                    ///< On the command line.
  bool check = false;
  bool info = false;
  bool timings = false;
  bool progress = false;

  bool clusters() const { return pipeline.cluster.tolerance > 0; }
};

/// Whether files are asked for beside the report.
inline bool writes_files(const Options& options) {
  return options.labels || options.mesh || options.image || options.view_html;
}

/// The commands that share these options.
enum class PcdBvCommand {
  alone,
  ranks  ///< pcd_bv_mpi, which has no use for files of partial results.
};

/// What the command line asks for: work, or (--help, --version, --print-config) only a text on
/// standard output. Throws UsageError.
std::variant<Options, std::string> parse_options(int argc, const char* const* argv,
                                                 PcdBvCommand command = PcdBvCommand::alone);

}  // namespace pcl_bv
