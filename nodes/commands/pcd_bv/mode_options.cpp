// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "mode_options.h"

#include <filesystem>
#include <vector>

#include "commands/shared/values.h"
#include "pcl_bv/fitting/partial.h"
#include "tiled_settings.h"

namespace pcl_bv::detail {

void reject_combinations(const CommandLine& line, const char* option,
                         std::initializer_list<const char*> others) {
  for (const char* other : others) {
    if (line.given(other)) throw UsageError(std::string(option) + ": cannot be combined with " + other);
  }
}

void reject_for_tiled_cloud(const CommandLine& line, const Options& options, PcdBvCommand command) {
  const PipelineConfig& config = options.pipeline;
  const char* const option = options.merge ? "--merge" : options.partial ? "--partial" : "--together";
  const bool over_ranks = command == PcdBvCommand::mpi;
  if (options.partial || !options.clusters()) reject_combinations(line, option, {"--labels"});
  const auto reject = [&](bool given, const std::string& what) {
    if (given) throw UsageError(std::string(option) + ": cannot be combined with " + what);
  };
  if (options.clusters()) {
    const std::string with_clusters = std::string(option) + " --cluster";
    reject_combinations(line, with_clusters.c_str(), {"--image", "--view-html"});
    if (!over_ranks) reject_combinations(line, with_clusters.c_str(), {"--gpu"});
  }
  const std::string setting =
      setting_not_for_tiles(config, options.clusters() || options.writes_ground_part());
  reject(!setting.empty(), setting);
  reject(over_ranks && options.clusters() && options.origin.requested && !options.origin.at,
         "--origin auto and --cluster over ranks");
  if (!options.merge && !options.partial) return;
  reject_combinations(line, option, {"--image", "--view-html", "--info"});
  if (options.partial || !options.clusters()) reject_combinations(line, option, {"--objects", "--check"});
  if (options.merge)
    reject_combinations(line, option,
                        {"--together", "--part", "--origin", "--range", "--drop-inside", "--keep-inside",
                         "--bin-fields", "--columns", "--topic"});
  if (options.partial)
    reject_combinations(line, "--partial", {"--format", "--output", "--mesh", "--timings"});
  if (options.writes_ground_part()) reject_combinations(line, "--partial --ground slope", {"--volume"});
  if (options.partial && !options.merge)
    reject(options.origin.requested && !options.origin.at, "--origin auto: each share would have its own");
  const bool all_methods = options.clusters() || options.writes_ground_part();
  for (const Method* method : all_methods ? std::vector<const Method*>() : config.methods()) {
    if (!Partial::can_fit(*method, config.method_options()))
      throw UsageError(std::string("--volume: ")
                           .append(method->name)
                           .append(method->needs_all_points ? "" : " with --concave")
                           .append(" needs all points, not only partial results: use --together"));
  }
}

void read_update(const CommandLine& line, Options& options) {
  options.update = true;
  reject_combinations(
      line, "--update",
      {"--bin-fields", "--columns",     "--topic",       "--origin",       "--together", "--memory",
       "--objects",    "--partial",     "--part",        "--ground-parts", "--merge",    "--gpu",
       "--format",     "--object-type", "--output",      "--labels",       "--mesh",     "--image",
       "--view-html",  "--check",       "--info",        "--timings",      "--progress", "--cluster",
       "--ground",     "--range",       "--drop-inside", "--keep-inside"});
  if (!line.given("--volume")) options.pipeline.volumes = {"aabb", "obb-dito14"};
}

void read_watch(const CommandLine& line, const std::string& folder, const std::string& format,
                Options& options) {
  options.watch = true;
  reject_combinations(line, "--watch",
                      {"--together", "--memory", "--partial", "--part", "--ground-parts", "--merge",
                       "--update", "--output", "--topic", "--progress"});
  if (has_one_input(options.format)) throw UsageError("--watch: cannot be combined with --format " + format);
  std::error_code missing;
  for (const auto* output :
       {&options.labels, &options.mesh, &options.image, &options.view_html, &options.objects})
    if (*output && std::filesystem::equivalent(**output, folder, missing))
      throw UsageError("--watch: outputs need another folder than " + folder);
}

}  // namespace pcl_bv::detail
