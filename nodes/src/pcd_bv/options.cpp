// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The options of pcd_bv and their help.

#include "options.h"

#include <algorithm>

#include "command/command_line.h"
#include "command/values.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/segmentation/up.h"
#include "values.h"

namespace pcl_bv {
namespace {

constexpr const char* examples = R"(Examples:
  pcd_bv scan.pcd                                        volumes around the whole cloud
  pcd_bv --volume dop26 --check --format json *.pcd      each proven to hold every point
  pcd_bv --ground zones --cluster 0.5 --image o.png s.pcd around each object, and a picture
  pcd_bv --cluster 0.5 --format jsonl sweeps/ | jq .counts
  pcd_bv --cluster 0.5 --format csv --mesh o.vtp s.bin   a line per volume, and ParaView's mesh
  pcd_bv --timings synth:street

Exit status: 0 done; 1 some input could not be processed or an output not written (the
other inputs are still done); 2 wrong use, or an instruction set that is not usable here;
3 --check found a point outside. The greater reason wins: 2, 3, 1, 0.
PCL_BV_ISA in the environment sets the default of --isa.)";

/// The command line as texts, before the values are looked at.
struct Texts {
  std::vector<std::string> inputs;
  std::string volume, range, cluster, min_size, max_size, ground, up, sensor_height, format, output, labels,
      mesh, image, view, threads, isa, growth, bin_fields;
  bool check = false, info = false, timings = false, progress = false;
};

std::string default_names() {
  std::string names;
  for (const Method* method : default_methods())
    names += (names.empty() ? "" : ",") + std::string(method->name);
  return names;
}

void declare(CommandLine& line, Texts& texts) {
  line.option("INPUT", texts.inputs, "",
              ".pcd, .ply, .las, .bin files, folders of them, synth:NAME[:POINTS[:SEED]]");
  line.option("--bin-fields", texts.bin_fields, "N", "Floats of a point of .bin files (4, or 5 of .pcd.bin)");
  line.option("--volume", texts.volume, "LIST",
              "Methods separated by commas, or all (" + default_names() + ")");
  line.option("--range", texts.range, "MIN:MAX", "Drop points nearer or farther than this from the origin");
  line.option("--cluster", texts.cluster, "TOL",
              "Segment first: points nearer than TOL to each other are one object");
  line.option("--min-size", texts.min_size, "N", "Drop clusters of fewer points (10)");
  line.option("--max-size", texts.max_size, "N", "Drop clusters of more points (no limit)");
  line.option("--ground", texts.ground, "KIND",
              "Take the ground away first: plane, zones (outdoors) or none (none)");
  line.option("--up", texts.up, "AXIS",
              "Against gravity, for --ground, upright boxes: x|y|z|-x|-y|-z|X,Y,Z (z)");
  line.option("--sensor-height", texts.sensor_height, "M", "Of the origin above the ground (learnt)");
  line.option("--format", texts.format, "FORMAT", "text, json, jsonl or csv (text)");
  line.option("--output", texts.output, "FILE", "Write the results here, not to standard output");
  line.option("--labels", texts.labels, "FILE.pcd",
              "Write the input with a field `label`; several inputs: a folder");
  line.option("--mesh", texts.mesh, "FILE", "Write the volumes as .ply or .vtp; several inputs: a folder");
  line.option("--image", texts.image, "FILE",
              "Draw cloud and volumes as .png or .svg; several inputs: a folder");
  line.option("--view", texts.view, "NAME", "From where the picture is taken: iso, top, front or side (iso)");
  line.option("--growth", texts.growth, "POLICY",
              "Growth of EPOS spheres: sequential, stationary or deferred (deferred)");
  line.option("--threads", texts.threads, "N", "Threads, 0 for all processors (0)");
  line.option("--isa", texts.isa, "NAME", "Instruction set, of those that --version lists (auto)");
  line.flag("--check", texts.check, "Verify every volume against every point in exact arithmetic");
  line.flag("--info", texts.info, "Add what the cloud is like: extent, spacing, bad points, fields");
  line.flag("--timings", texts.timings, "Add the seconds of each stage");
  line.flag("--progress", texts.progress, "Show how far it is, where standard error is a terminal");
}

std::optional<std::filesystem::path> path_or_none(const CommandLine& line, const char* option,
                                                  const std::string& text) {
  if (!line.given(option)) return std::nullopt;
  if (text.empty()) throw UsageError(std::string(option) + ": the name is empty");
  return text;
}

/// A file's extension must be one of these; a name without one may be a folder's.
void require_extension(const char* option, const std::string& name,
                       std::initializer_list<std::string_view> known) {
  const std::string extension = lower_case_extension(name);
  std::error_code unknown;
  if (extension.empty() || std::filesystem::is_directory(name, unknown)) return;
  std::string list;
  for (const std::string_view each : known) {
    if (extension == each) return;
    list += (list.empty() ? "" : " or ") + std::string(each);
  }
  throw UsageError(std::string(option) + ": '" + name + "' is no " + list + " file");
}

/// For those who ask: the ground and upright boxes.
void set_up(const Eigen::Vector3d& up, bool wants_ground, Options& options) {
  const bool wants_upright = std::any_of(options.methods.begin(), options.methods.end(),
                                         [](const Method* method) { return method->upright; });
  if (!wants_ground && !wants_upright) {
    throw UsageError("--up: only useful with --ground or an upright box, obb-yaw or obb-lshape");
  }
  if (options.ground) options.ground->up = up;
  options.method_options.up = up_direction(up);
}

void refuse_useless(const CommandLine& line) {
  for (const auto& [option, needed] : {std::pair{"--min-size", "--cluster"},
                                       {"--max-size", "--cluster"},
                                       {"--view", "--image"},
                                       {"--sensor-height", "--ground"}}) {
    if (line.given(option) && !line.given(needed))
      throw UsageError(std::string(option) + ": only useful with " + needed);
  }
}

/// What of the cloud the volumes are fitted around.
void read_segmentation(const CommandLine& line, const Texts& texts, Options& options) {
  if (line.given("--range")) {
    const auto [min, max] = parse_range(texts.range);
    options.range = RangeFilter{min, max};
  }
  if (line.given("--ground")) options.ground = parse_ground(texts.ground);
  if (options.ground && line.given("--sensor-height")) {
    options.ground->sensor_height = parse_sensor_height(texts.sensor_height);
  }
  if (line.given("--cluster")) options.tolerance = parse_tolerance(texts.cluster);
  if (line.given("--min-size")) options.min_size = parse_whole_number("--min-size", texts.min_size);
  if (line.given("--max-size")) options.max_size = parse_whole_number("--max-size", texts.max_size, 1);
  if (options.min_size > options.max_size) {
    throw UsageError("--max-size: " + std::to_string(options.max_size) + " is below --min-size " +
                     std::to_string(options.min_size));
  }
}

void read_outputs(const CommandLine& line, const Texts& texts, Options& options) {
  if (line.given("--format")) options.format = parse_format(texts.format);
  options.output = path_or_none(line, "--output", texts.output);
  options.labels = path_or_none(line, "--labels", texts.labels);
  options.mesh = path_or_none(line, "--mesh", texts.mesh);
  options.image = path_or_none(line, "--image", texts.image);
  require_extension("--image", texts.image, {".png", ".svg"});
  require_extension("--mesh", texts.mesh, {".ply", ".vtp"});
  if (line.given("--view")) options.view = parse_view(texts.view);
  options.check = texts.check;
  options.info = texts.info;
  options.timings = texts.timings;
  options.progress = texts.progress;
}

Options to_options(const CommandLine& line, const Texts& texts) {
  constexpr std::size_t max_threads = 1024;
  if (texts.inputs.empty()) throw UsageError("no INPUT; pcd_bv --help lists the options");
  refuse_useless(line);
  Options options;
  options.inputs = texts.inputs;
  options.methods = line.given("--volume") ? parse_methods(texts.volume) : default_methods();
  read_segmentation(line, texts, options);
  if (line.given("--bin-fields")) options.bin_fields = parse_bin_fields(texts.bin_fields);
  if (line.given("--up")) set_up(parse_with("--up", texts.up, parse_up), line.given("--ground"), options);
  if (line.given("--growth"))
    options.method_options.growth = parse_with("--growth", texts.growth, parse_growth);
  read_outputs(line, texts, options);
  Threads threads;
  if (line.given("--threads")) {
    threads.threads = static_cast<unsigned>(parse_whole_number("--threads", texts.threads, 0, max_threads));
  }
  options.execution = {threads, parse_usable_isa(line.given("--isa") ? texts.isa : "auto")};
  return options;
}

}  // namespace

std::variant<Options, std::string> parse_options(int argc, const char* const* argv) {
  CommandLine line("pcd_bv",
                   "Bounding volumes of point clouds: boxes, k-DOPs and spheres that hold every point.",
                   examples);
  Texts texts;
  declare(line, texts);
  if (auto text = line.parse(argc, argv)) return *std::move(text);
  return to_options(line, texts);
}

}  // namespace pcl_bv
