// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The command line of pcd_bv, checked whole before any work begins.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "command/usage_error.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/report/picture.h"
#include "pcl_bv/segmentation/ground_plane.h"

namespace pcl_bv {

/// Distances from the origin that are kept, both ends included; unit of the points.
struct RangeFilter {
  double min = 0;
  double max = std::numeric_limits<double>::infinity();
};

enum class GroundKind { plane, zones };

/// What is taken for ground.
struct GroundOptions {
  GroundKind kind = GroundKind::plane;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Against gravity; any length above 0.
  std::optional<double> sensor_height;            ///< Metres; learnt if not given.
};

enum class OutputFormat { text, json, jsonl, csv };

struct Options {
  std::vector<std::string> inputs;
  std::size_t bin_fields = 0;  ///< As read_cloud() takes it.
  std::vector<const Method*> methods;
  std::optional<RangeFilter> range;
  std::optional<GroundOptions> ground;  ///< Take the ground away if set.
  std::optional<float> tolerance;       ///< Cluster if set.
  std::size_t min_size = 10;
  std::size_t max_size = std::numeric_limits<std::size_t>::max();
  OutputFormat format = OutputFormat::text;
  std::optional<std::filesystem::path> output, labels, mesh, image;
  ViewFrom view = ViewFrom::iso;
  MethodOptions method_options;
  Execution execution{Serial{}, Isa::scalar};  ///< The environment is asked only where --isa is not given.
  bool check = false;
  bool info = false;
  bool timings = false;
  bool progress = false;
};

/// Whether files are asked for beside the report.
inline bool writes_files(const Options& options) {
  return options.labels || options.mesh || options.image;
}

/// What the command line asks for: work, or (--help, --version) only a text on standard output. Throws
/// UsageError.
std::variant<Options, std::string> parse_options(int argc, const char* const* argv);

}  // namespace pcl_bv
