// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The options of pcd_bv and their help.

#include "options.h"

#include <algorithm>
#include <initializer_list>

#include "box_format.h"
#include "commands/shared/command_line.h"
#include "commands/shared/setting_options.h"
#include "commands/shared/values.h"
#include "gpu_supports.h"
#include "mode_options.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/io/text_cloud.h"
#include "pcl_bv/report/picture.h"
#include "pipeline/config/names.h"
#include "pipeline/config/settings.h"

namespace pcl_bv::detail {
namespace {

constexpr const char* examples = R"(Examples:
  pcd_bv scan.pcd                                        volumes around the whole cloud
  pcd_bv --volume dop26 --check --format json *.pcd      checked: no point is left outside
  pcd_bv --ground zones --cluster 0.5 --image o.png s.pcd around each object, and a picture
  pcd_bv --cluster 0.5 --format jsonl sweeps/ | jq .counts
  pcd_bv --cluster 0.5 --format csv --mesh o.vtp s.bin   a line per volume, and ParaView's mesh
  pcd_bv --together tiles/                               one cloud in many files, one result
  pcd_bv --timings synth:street

Exit status: 0 done; 1 some input could not be processed or an output not written (the
other inputs are still done); 2 wrong use, or an instruction set that is not usable here;
3 --check found a point outside. If several apply, the first of 2, 3, 1, 0 is returned.
PCL_BV_ISA in the environment sets the default of --isa.)";

constexpr Names<ViewFrom, 4> kViews{
    {{"iso", ViewFrom::iso}, {"top", ViewFrom::top}, {"front", ViewFrom::front}, {"side", ViewFrom::side}}};

const char* name_of(PcdBvCommand command) {
  return command == PcdBvCommand::serial ? "pcd_bv" : "pcd_bv_mpi";
}

/// The values of the command line as texts, before they are parsed.
struct Texts {
  std::vector<std::string> inputs;
  std::string format, output, labels, mesh, image, view, view_html, bin_fields, topic, origin, partial, part,
      ground_parts, gpu, memory, objects, object_type, columns, watch;
  bool together = false, merge = false, update = false, check = false, info = false, timings = false,
       progress = false;
};

void declare(CommandLine& line, Texts& texts, PcdBvCommand command) {
  line.option(
      "INPUT", texts.inputs, "",
      ".pcd, .ply, .las, .laz, .bin, .npy, .npz, .xyz, .csv, .txt,\n.asc, .pts files, folders of the "
      "first five,\nsynth:NAME[:POINTS[:SEED]], recordings (.mcap, .bag, .db3 or\nits folder), packets "
      "(.pcap, .pcapng)");
  line.option("--bin-fields", texts.bin_fields, "N", "Floats of a point of .bin files (4, or 5 of .pcd.bin)");
  line.option(
      "--columns", texts.columns, "LIST",
      "Columns of text files, such as x,y,z,intensity,label:u4,_\n(those of the header, or x,y,z,...)");
  line.option("--topic", texts.topic, "NAME",
              "The topic of recordings, where several have clouds;\nof packets ADDRESS:PORT of a sensor");
  line.option("--origin", texts.origin, "X,Y,Z",
              "Subtract this origin; auto: the centre of each cloud, rounded");
  line.flag("--together", texts.together, "All inputs are parts of one cloud: one result");
  line.option("--memory", texts.memory, "MB",
              "With --cluster and --together, --partial or --merge:\nmemory for points (600)");
  if (command == PcdBvCommand::serial) {
    line.option("--watch", texts.watch, "DIR",
                "Process files as they arrive in this folder, until a signal:\nfiles closed after writing, "
                "or moved in");
    line.flag(
        "--update", texts.update,
        "Inputs are tilesets of 3D Tiles: compute the bounding volumes\nof their tiles anew, in the files");
    line.option(
        "--objects", texts.objects, "DIR",
        "With --cluster: write the points of each object as DIR/ID.pcd;\nseveral inputs: DIR/NAME/ID.pcd");
    line.option("--partial", texts.partial, "FILE",
                "Write partial results for --merge instead of volumes, or the\nground for --ground-parts "
                "(--ground slope without --cluster)");
    line.option("--part", texts.part, "K/N", "With --partial: only share K of N, K from 0 (0/1)");
    line.option("--ground-parts", texts.ground_parts, "PATH",
                "With --partial, --cluster and --ground slope: folder of the files\nof all shares that "
                "--partial --ground slope wrote before");
    line.flag("--merge", texts.merge, "Inputs are files that --partial wrote, or folders of them");
    line.option("--gpu", texts.gpu, "DEVICE",
                "Fit on a graphics card: auto, its number or a part of its name;\nwith --version: list them");
  }
  line.option("--format", texts.format, "FORMAT",
              "text, json, jsonl or csv (text); boxes for labelling tools\nand benchmarks: kitti, "
              "kitti-tracking, nuscenes, openlabel\nor sustech; 3dtiles: bounding volumes of 3D "
              "Tiles;\n3dtiles-region: regions, for clouds in longitude, latitude, height");
  line.option("--object-type", texts.object_type, "NAME", "Type of all objects in the formats of boxes");
  line.option("--output", texts.output, "FILE", "Write the results here, not to standard output");
  line.option("--labels", texts.labels, "FILE.pcd",
              "Write the input with a field `label`; several inputs: a folder");
  line.option("--mesh", texts.mesh, "FILE",
              "Write the volumes as .ply, .vtp or .glb; several inputs: a folder");
  line.option("--image", texts.image, "FILE",
              "Draw cloud and volumes as .png or .svg; several inputs: a folder");
  line.option("--view", texts.view, "NAME", "Viewpoint of the picture: iso, top, front or side (iso)");
  line.option("--view-html", texts.view_html, "FILE.html",
              "Write a page that shows cloud and volumes; several inputs: a folder");
  line.flag("--check", texts.check, "Verify every volume against every point in exact arithmetic");
  line.flag("--info", texts.info, "Add statistics of the cloud: extent, spacing, invalid points, fields");
  line.flag("--timings", texts.timings, "Add the seconds of each stage");
  line.flag("--progress", texts.progress, "Show a progress bar if standard error is a terminal");
}

// Returns nullopt for an empty name. The parser rejects empty names on the command line, so an empty name
// means that the option is absent.
std::optional<std::filesystem::path> path_or_none(const std::string& name) {
  if (name.empty()) return std::nullopt;
  return name;
}

/// Throws UsageError if the extension of the file is not in `known`. Names of folders and names without an
/// extension are allowed.
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
  reject_value(option, name, "is no " + list + " file");
}

OriginOption parse_origin(const std::string& text) {
  OriginOption origin{true, {}};
  if (text == "auto") return origin;
  parse_with("--origin", text, [&](const std::string& numbers) { read_text(numbers, origin.at); });
  if (origin.at && origin.at->allFinite()) return origin;
  reject_value("--origin", text, "is not X,Y,Z, all finite, or auto");
}

void reject_useless(const CommandLine& line, const PipelineConfig& config) {
  if (line.given("--view") && !line.given("--image")) throw UsageError("--view: only useful with --image");
  const std::vector<const Method*> methods = config.methods();
  const bool upright =
      std::any_of(methods.begin(), methods.end(), [](const Method* m) { return m->upright; });
  const bool useful = upright || config.ground.method != GroundMethod::none || line.given("--ground") ||
                      line.given("--image");
  if (line.given("--up") && !useful)
    throw UsageError(
        "--up: only useful with --ground, --image or an upright box or prism: obb-yaw, obb-lshape, prism");
}

void read_outputs(const CommandLine& line, const Texts& texts, Options& options) {
  if (line.given("--format")) options.format = parse_with("--format", texts.format, read_output_format);
  options.output = path_or_none(texts.output);
  options.labels = path_or_none(texts.labels);
  options.mesh = path_or_none(texts.mesh);
  options.image = path_or_none(texts.image);
  options.view_html = path_or_none(texts.view_html);
  options.objects = path_or_none(texts.objects);
  if (options.objects && !options.clusters()) throw UsageError("--objects: only useful with --cluster");
  require_extension("--labels", texts.labels, {".pcd"});
  require_extension("--image", texts.image, {".png", ".svg"});
  require_extension("--view-html", texts.view_html, {".html"});
  require_extension("--mesh", texts.mesh, {".ply", ".vtp", ".glb"});
  if (line.given("--view"))
    options.view =
        parse_with("--view", texts.view, [](const std::string& name) { return read_name(kViews, name); });
  options.check = texts.check;
  options.info = texts.info;
  options.timings = texts.timings;
  options.progress = texts.progress;
}

ShareOption parse_share(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) reject_value("--part", text, "is not K/N, such as 0/8");
  ShareOption share;
  share.count = parse_whole_number("--part", text.substr(slash + 1), 1, 1'000'000);
  share.number = parse_whole_number("--part", text.substr(0, slash), 0, share.count - 1);
  return share;
}

void read_memory(const CommandLine& line, const Texts& texts, Options& options) {
  if (line.given("--memory")) {
    if (!(texts.together || texts.merge || !texts.partial.empty()) || !options.clusters())
      throw UsageError("--memory: only useful with --cluster and --together, --partial or --merge");
    options.memory_bytes = parse_whole_number("--memory", texts.memory, 1, 1'000'000) * 1'000'000;
  }
}

void read_parts(const CommandLine& line, const Texts& texts, Options& options) {
  options.merge = texts.merge;
  options.partial = path_or_none(texts.partial);
  options.tiled = texts.together || (options.partial && !options.merge);
  if (line.given("--part")) options.share = parse_share(texts.part);
  if (line.given("--part") && !options.partial) throw UsageError("--part: only useful with --partial");
  options.ground_parts = path_or_none(texts.ground_parts);
  const bool objects = options.partial && !options.merge && options.clusters() && options.slope_ground();
  if (options.ground_parts && !objects)
    throw UsageError("--ground-parts: only useful with --partial, --cluster and --ground slope");
  if (objects && !options.ground_parts)
    throw UsageError(
        "--partial --cluster: --ground slope needs --ground-parts: files of all shares that --partial and "
        "--ground slope wrote without --cluster");
}

Options to_options(const CommandLine& line, const Texts& texts, PipelineConfig config, PcdBvCommand command) {
  if (!texts.watch.empty() && !texts.inputs.empty())
    throw UsageError("--watch: its files are the only inputs");
  if (texts.inputs.empty() && texts.watch.empty())
    throw UsageError(std::string("no INPUT; ") + name_of(command) + " --help lists the options");
  reject_useless(line, config);
  Options options;
  options.inputs = texts.watch.empty() ? texts.inputs : std::vector{texts.watch};
  options.pipeline = std::move(config);
  options.topic = texts.topic;
  if (line.given("--bin-fields")) options.bin_fields = parse_bin_fields(texts.bin_fields);
  if (line.given("--columns")) {
    parse_with("--columns", texts.columns, parse_columns);
    options.columns = texts.columns;
  }
  if (line.given("--origin")) options.origin = parse_origin(texts.origin);
  const GroundConfig& ground = options.pipeline.ground;
  if (options.origin.requested && !options.origin.at && ground.sensor && ground.method == GroundMethod::zones)
    throw UsageError(
        "--origin auto: cannot be combined with --sensor (ground.sensor), whose coordinates are those after "
        "the subtraction: use --origin X,Y,Z");
  read_outputs(line, texts, options);
  if (line.given("--object-type"))
    options.object_type = checked_object_type(texts.object_type, options.format);
  check_box_format(texts.format, options);
  options.tiled = texts.together;
  options.threads_given = line.given("--threads");
  read_memory(line, texts, options);
  if (command == PcdBvCommand::serial) read_parts(line, texts, options);
  if (texts.update) read_update(line, options);
  if (!texts.watch.empty()) read_watch(line, texts.watch, texts.format, options);
  options.gpu = texts.gpu;
  if (!options.gpu.empty()) reject_combinations(line, "--gpu", {"--partial", "--merge"});
  if (options.tiled || options.merge) reject_for_tiled_cloud(line, options, command);
  return options;
}

}  // namespace

std::variant<Options, std::string> parse_options(int argc, const char* const* argv, PcdBvCommand command) {
  CommandLine line(name_of(command),
                   "Bounding volumes of point clouds: boxes, k-DOPs and spheres that hold every point.",
                   examples);
  Texts texts;
  declare(line, texts, command);
  SettingOptions settings(line, {whole_cloud_config(), {}}, false);
  if (auto text = line.parse(argc, argv)) {
    if (!texts.gpu.empty() && line.given("--version")) *text += gpu_list();
    return *std::move(text);
  }
  std::string range_from;
  StreamConfig config = settings.config(&range_from);
  if (settings.print_config()) return to_yaml(config);
  Options options = to_options(line, texts, std::move(config.pipeline), command);
  options.config_file = settings.file();
  options.range_from = std::move(range_from);
  return options;
}

}  // namespace pcl_bv::detail
