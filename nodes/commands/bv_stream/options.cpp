// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The options of bv_stream and their help. Options override the configuration file.

#include "options.h"

#include <algorithm>
#include <utility>

#include "commands/shared/command_line.h"
#include "commands/shared/kitti_boxes.h"
#include "commands/shared/messages.h"
#include "commands/shared/output_claims.h"
#include "commands/shared/setting_options.h"
#include "commands/shared/values.h"
#include "pcl_bv/io/list_clouds.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/read_cloud.h"
#include "pipeline/config/names.h"

namespace pcl_bv::detail {
namespace {

constexpr const char* examples = R"(Examples:
  bv_stream --source sweeps/ --rate max > objects.jsonl     a recording, as fast as it goes
  bv_stream --source sweeps/ --rate 10 --track --sink vtp:paraview/ --stats stats.json
  bv_stream --print-config > robot.yaml; bv_stream --config robot.yaml --source sweeps/
  bv_stream --source synth:street-sequence:100 --volume aabb,dop26 | jq -c .counts
  bv_stream --source drive.mcap --track --sink ws:8765      then open http://localhost:8765/

Exit status: 0 done, also after SIGINT, SIGTERM or SIGHUP, which let the frames in the queue be
done first (a second one ends at once, with 128 + its number); 1 a source without a readable cloud,
another unreadable input, or an output not written; 2 wrong use or a bad configuration.
PCL_BV_ISA in the environment sets the default of --isa.)";

struct Texts {
  std::string topic, rate, stamps, frame_id, poses, bin_fields, loop, stats, report;
  std::vector<std::string> sources, sinks;
};

void declare_frames(CommandLine& line, Texts& t) {
  line.option("--source", t.sources, "SOURCE",
              source_syntax() + "\nRepeatable: --target-frame merges the clouds of all sensors");
  line.option("--bin-fields", t.bin_fields, "N", "Floats of a point of .bin files (4, or 5 of .pcd.bin)");
  line.option("--topic", t.topic, "NAME",
              "The topic of a recording, where several have clouds;\nof packets ADDRESS:PORT of a sensor");
  line.option(
      "--rate", t.rate, "HZ",
      "Frames a second, recorded (by their stamps) or max\n(10; recorded where the source is a recording)");
  line.option("--loop", t.loop, "N", "Repeat the source N times (1)");
  line.option("--stamps", t.stamps, "RULE",
              "Stamps of the frames: rate, or name for the time in the file name\n"
              "(rate; name with --rate recorded)");
  line.option("--frame-id", t.frame_id, "NAME", "The coordinate frame of the points");
  line.option("--poses", t.poses, "FILE", "Sensor poses: KITTI format (by frame) or TUM format (by time)");
}

void declare_results(CommandLine& line, Texts& t) {
  line.option("--sink", t.sinks, "SINK", sink_syntax() + "; repeatable (jsonl on standard output)");
  line.option("--stats", t.stats, "FILE.json", "Write counters and percentiles at the end");
  line.option("--report", t.report, "SECONDS",
              "Print counters and latency at this interval on standard error");
}

double number(const char* option, std::string_view text, double min, double max, const char* allowed) {
  double value = 0;
  if (read_whole_text(text, value) && value >= min && value <= max) return value;
  reject_value(option, text, std::string("is not ") + allowed);
}

void claim_source(const std::string& source, OutputClaims& claims) {
  claims.add_input(source);
  std::error_code unknown;
  if (!std::filesystem::is_directory(source, unknown)) return;
  try {
    std::size_t subfolders = 0;
    for (const std::filesystem::path& cloud : list_clouds(source, &subfolders))
      claims.add_input(cloud);
    warn_of_subfolders(source, subfolders);
  } catch (const IoError& error) {
    throw IoError(source + ": " + error.what());
  }
}

// Throws UsageError if an output would overwrite an input or another output.
void claim_outputs(const StreamOptions& options, const std::string& config) {
  OutputClaims claims;
  for (const std::string& source : options.sources)
    claim_source(source, claims);
  if (!options.config.rig.urdf.empty()) claims.add_input(options.config.rig.urdf);
  if (!config.empty()) claims.add_input(config);
  for (const RegionConfig& region : options.config.pipeline.filter.regions)
    claims.add_input(region.file);
  if (!options.replay.poses.empty()) claims.add_input(options.replay.poses);
  bool printed = false;
  for (const SinkOptions& sink : options.sinks) {
    if (sink.kind->live) continue;
    if (sink.target == "-") {
      if (std::exchange(printed, true))
        throw UsageError("--sink: more than one result would be written to standard output");
      continue;
    }
    const std::string_view files = sink.kind->files;
    files.empty() ? claims.claim_in_place(sink.target)
                  : claims.claim(sink.target / ("frame000000" + std::string(files)));
    if (files == ".pcd") claims.reject_input(sink.target);  // the source would read the clouds of the sink
  }
  if (options.stats) {
    claims.claim(*options.stats);
    require_folder_of(*options.stats);
  }
}

// Returns where all sources take the times of frames from. Sources with own times and sources without cannot
// be merged, because their stamps have nothing in common.
FrameTimes common_times(const std::vector<std::string>& sources) {
  const FrameTimes times = source_kind(sources.front()).times;
  for (const std::string& source : sources)
    if (source_kind(source).times != times)
      throw UsageError("--source: " + sources.front() + " and " + source +
                       " are of different kinds and have no common stamps");
  return times;
}

bool exists(const std::string& source) {
  std::error_code unknown;
  return std::filesystem::exists(source, unknown);
}

// Returns whether the source is a .bin file or a folder with one.
bool has_bin_files(const std::string& source) {
  const auto is_bin = [](const std::filesystem::path& file) { return lower_case_extension(file) == ".bin"; };
  std::error_code unknown;
  if (!std::filesystem::is_directory(source, unknown)) return is_bin(source);
  try {
    const std::vector<std::filesystem::path> clouds = list_clouds(source);
    return std::any_of(clouds.begin(), clouds.end(), is_bin);
  } catch (const IoError& error) {
    throw IoError(source + ": " + error.what());
  }
}

// Throws UsageError for options that have no effect on these sources.
void reject_useless_for_sources(const CommandLine& line, const Texts& t, const StreamConfig& config,
                                FrameTimes times) {
  const bool files = times == FrameTimes::names, merges = !config.rig.frame.empty();
  for (const std::string& source : t.sources)
    if (files && !exists(source)) throw IoError(source + ": no such file or folder");
  const bool bin =
      files && line.given("--bin-fields") && std::any_of(t.sources.begin(), t.sources.end(), has_bin_files);
  if (line.given("--topic") && merges && !config.rig.sensors.empty())
    throw UsageError("--topic: cannot be combined with rig.sensors, which names the topics");
  reject_useless({{"--topic", line.given("--topic"), times == FrameTimes::messages, "a recording"},
                  {"--bin-fields", line.given("--bin-fields"), bin, ".bin files"},
                  {"--stamps name", t.stamps == "name", files, "files, whose names have times"}});
}

void read_replay(const CommandLine& line, const Texts& t, StreamOptions& options) {
  ReplayOptions& replay = options.replay;
  const FrameTimes times = common_times(options.sources);
  replay.frame_id = t.frame_id;
  replay.poses = t.poses;
  if (times == FrameTimes::live) {
    for (const char* option : {"--rate", "--loop", "--stamps", "--topic", "--bin-fields"})
      if (line.given(option)) throw UsageError(std::string(option) + ": not with a live source");
    options.rate = Rate::live;
    return;
  }
  const bool recorded = line.given("--rate") ? t.rate == "recorded" : times == FrameTimes::messages;
  options.rate = t.rate == "max" ? Rate::max : recorded ? Rate::recorded : Rate::fixed;
  if (line.given("--rate") && options.rate == Rate::fixed)
    replay.rate_hz =
        number("--rate", t.rate, kMinRate, kMaxRate, "a rate from 0.001 to 1000000, recorded or max");
  if (line.given("--loop")) replay.loops = parse_whole_number("--loop", t.loop, 1);
  if (line.given("--stamps") && t.stamps != "rate" && t.stamps != "name")
    reject_value("--stamps", t.stamps, "is not rate or name");
  replay.own_stamps = line.given("--stamps")
                          ? t.stamps == "name"
                          : times == FrameTimes::messages || (recorded && times == FrameTimes::names);
  const bool merges = !options.config.rig.frame.empty();
  if (merges && times == FrameTimes::messages && !replay.own_stamps)
    throw UsageError(
        "--stamps rate: not with --target-frame, because transforms have the times of the recording");
  replay.topic = t.topic;
  reject_useless_for_sources(line, t, options.config, times);
  if (line.given("--bin-fields")) replay.bin_fields = parse_bin_fields(t.bin_fields);
}

StreamOptions to_options(const CommandLine& line, const Texts& t, const std::string& config_file,
                         StreamConfig config) {
  StreamOptions options;
  options.config = std::move(config);
  if (!line.given("--source")) throw UsageError("no --source; bv_stream --help lists the options");
  options.sources = t.sources;
  const bool merges = !options.config.rig.frame.empty();
  if (t.sources.size() > 1 && !merges)
    throw UsageError("--source: several sources need --target-frame, the frame of their merged clouds");
  if (merges && line.given("--loop")) throw UsageError("--loop: not with --target-frame");
  if (merges && line.given("--frame-id")) throw UsageError("--frame-id: not with --target-frame");
  reject_useless({{"--sync", line.given("--sync"), merges, "--target-frame"}});
  options.replay.point_times = options.config.pipeline.deskew != Deskew::off;
  read_replay(line, t, options);
  if (const auto& field = options.config.pipeline.cluster.class_field)
    options.replay.class_field = field->name;
  for (const std::string& sink : line.given("--sink") ? t.sinks : std::vector<std::string>{"jsonl:-"})
    options.sinks.push_back(parse_with("--sink", sink, parse_sink));
  for (const SinkOptions& sink : options.sinks)
    if (sink.kind->name == "kitti") check_kitti_boxes("--sink kitti", options.config.pipeline);
  if (line.given("--stats")) options.stats = t.stats;
  if (line.given("--report"))
    options.report_seconds = number("--report", t.report, 0.001, 1e6, "seconds from 0.001 to 1000000");
  claim_outputs(options, config_file);
  return options;
}

}  // namespace

std::variant<StreamOptions, std::string> parse_stream_options(int argc, const char* const* argv) {
  CommandLine line("bv_stream", "Objects in a stream of point clouds, as volumes that hold every point.",
                   examples);
  Texts texts;
  declare_frames(line, texts);
  StreamConfig defaults;
  defaults.pipeline.threads = 0;
  SettingOptions settings(line, defaults, true);
  declare_results(line, texts);
  if (auto text = line.parse(argc, argv)) return *std::move(text);
  std::string range_from;
  StreamConfig config = settings.config(&range_from);
  if (settings.print_config()) return to_yaml(config);
  StreamOptions options = to_options(line, texts, settings.file(), std::move(config));
  options.range_from = std::move(range_from);
  return options;
}

}  // namespace pcl_bv::detail
