// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The options of bv_stream and their help. Flags override the file.

#include "options.h"

#include "command/command_line.h"
#include "command/output_claims.h"
#include "command/setting_options.h"
#include "command/values.h"
#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/list_clouds.h"

namespace pcl_bv {
namespace {

constexpr const char* examples = R"(Examples:
  bv_stream --source sweeps/ --rate max > objects.jsonl     a recording, as fast as it goes
  bv_stream --source sweeps/ --rate 10 --track --sink vtp:paraview/ --stats stats.json
  bv_stream --print-config > robot.yaml; bv_stream --config robot.yaml --source sweeps/
  bv_stream --source synth:street-sequence:100 --volume aabb,dop26 | jq -c .counts

Exit status: 0 done, also after SIGINT or SIGTERM, which let the frames in the queue be done
first (a second one ends at once, with 130); 1 no readable source or an output not written;
2 wrong use or a bad configuration.
PCL_BV_ISA in the environment sets the default of --isa.)";

struct Texts {
  std::string source, rate, stamps, bin_fields, loop, stats;
  std::vector<std::string> sinks;
};

void declare(CommandLine& line, Texts& t) {
  line.option("--source", t.source, "PATH",
              "A folder of clouds, one file, or synth:street-sequence[:FRAMES[:SEED]]");
  line.option("--bin-fields", t.bin_fields, "N", "Floats of a point of .bin files (4, or 5 of .pcd.bin)");
  line.option("--rate", t.rate, "HZ", "Frames a second, or max (10)");
  line.option("--loop", t.loop, "N", "Repeat the source N times (1)");
  line.option("--stamps", t.stamps, "RULE",
              "Times of the frames: by rate, or by the number in the name (rate)");
  line.option("--sink", t.sinks, "KIND:PLACE",
              "jsonl:FILE, csv:FILE or vtp:FOLDER; repeatable (jsonl on standard output)");
  line.option("--stats", t.stats, "FILE.json", "Write counters and percentiles at the end");
}

double number(const char* option, std::string_view text, const char* wanted) {
  double value = 0;
  if (read_number(text, value)) return value;
  throw UsageError(std::string(option) + ": " + quoted(text) + " is not " + wanted);
}

// Refuses to write over what is read, and two outputs into one file.
void claim_outputs(const StreamOptions& options, const std::string& config) {
  OutputClaims claims;
  claims.add_input(options.source);
  if (!config.empty()) claims.add_input(config);
  std::error_code unknown;
  try {
    if (std::filesystem::is_directory(options.source, unknown)) {
      for (const std::filesystem::path& cloud : list_clouds(options.source))
        claims.add_input(cloud);
    }
  } catch (const IoError& error) {
    throw IoError(options.source + ": " + error.what());
  }
  for (const SinkDescription& sink : options.sinks)
    claims.claim(sink.kind == SinkKind::vtp ? sink.place / "frames.pvd" : sink.place);
  if (options.stats) claims.claim(*options.stats);
}

StreamOptions to_options(const CommandLine& line, const Texts& t, const std::string& config_file,
                         StreamConfig config) {
  StreamOptions options;
  options.config = std::move(config);
  if (!line.given("--source")) throw UsageError("no --source; bv_stream --help lists the options");
  options.source = t.source;
  options.paced = t.rate != "max";
  if (line.given("--rate") && options.paced)
    options.stamps.rate_hz = number("--rate", t.rate, "a rate or max");
  if (!(options.stamps.rate_hz >= kLeastRate && options.stamps.rate_hz <= kGreatestRate))
    throw UsageError("--rate: '" + t.rate + "' is not a rate from 0.001 to 1000000, or max");
  if (line.given("--loop")) options.loops = parse_whole_number("--loop", t.loop, 1);
  if (line.given("--stamps") && t.stamps != "rate" && t.stamps != "name")
    throw UsageError("--stamps: '" + t.stamps + "' is not rate or name");
  options.stamps.from_name = t.stamps == "name";
  if (line.given("--bin-fields")) options.stamps.bin_fields = parse_bin_fields(t.bin_fields);
  if (options.stamps.from_name && t.source.rfind("synth:", 0) == 0)
    throw UsageError("--stamps name: synth: has no names");
  if (line.given("--sink")) options.sinks.clear();
  for (const std::string& sink : t.sinks)
    options.sinks.push_back(parse_with("--sink", sink, parse_sink));
  if (line.given("--stats")) options.stats = t.stats;
  claim_outputs(options, config_file);
  return options;
}

}  // namespace

std::variant<StreamOptions, std::string> parse_stream_options(int argc, const char* const* argv) {
  CommandLine line("bv_stream", "Objects in a stream of point clouds, as volumes that hold every point.",
                   examples);
  Texts texts;
  declare(line, texts);
  StreamConfig defaults;
  defaults.pipeline.threads = 0;
  const SettingOptions settings(line, defaults, true);
  if (auto text = line.parse(argc, argv)) return *std::move(text);
  StreamConfig config = settings.config();
  if (settings.print_config()) return to_yaml(config);
  return to_options(line, texts, settings.file(), std::move(config));
}

}  // namespace pcl_bv
