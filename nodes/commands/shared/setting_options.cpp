// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "setting_options.h"

#include <algorithm>
#include <optional>
#include <type_traits>
#include <utility>

#include "messages.h"
#include "pipeline/config/check.h"
#include "pipeline/config/rows.h"
#include "pipeline/config/settings.h"
#include "values.h"

namespace pcl_bv::detail {
namespace {

std::string shown_default(const Setting& setting, const std::string& value) {
  return value.empty() || value == "null" ? std::string(setting.unset) : value;
}

// Returns whether the setting has an option. Settings that need several frames, and those of the runner, have
// options only in commands for streams.
bool has_option(const Setting& setting, bool stream) {
  const std::string_view stage = setting.key.substr(0, setting.key.find('.'));
  return !setting.option.empty() &&
         (stream || (stage != "track" && stage != "runner" && stage != "deskew" && stage != "rig"));
}

// Removes repeated methods. The command line may repeat a method, but a configuration file may not.
void keep_first_mentions(std::vector<std::string>& methods) {
  std::vector<std::string> once;
  for (std::string& name : methods) {
    const auto same = [&](const std::string& other) { return find_method(other) == find_method(name); };
    if (find_method(name) == nullptr || std::none_of(once.begin(), once.end(), same))
      once.push_back(std::move(name));
  }
  methods = std::move(once);
}

std::pair<double, double> range_limits(const StreamConfig& config) {
  return {config.pipeline.filter.range_min, config.pipeline.filter.range_max};
}

// Returns the option of a setting. If only a part of the option's value belongs to the setting, appends the
// name of this part: "--range MAX".
std::string option_of(const Setting& setting) {
  const std::string option(setting.option);
  return setting.part.name.empty() ? option : option + ' ' + std::string(setting.part.name);
}

// Returns the help of an option: one line, with the choices and the default, for each setting that the option
// sets.
std::string help_of(std::string_view option, const StreamConfig& defaults) {
  std::string help;
  visit_stream(defaults, [&](const Setting& setting, const auto& value) {
    if (setting.option != option) return;
    help.append(help.empty() ? "" : "\n").append(setting.help);
    if (std::is_enum_v<std::decay_t<decltype(value)>>) help.append(": ").append(setting.unit);
    help += " (" + shown_default(setting, to_text(value)) + ")";
  });
  return help;
}

// Removes the part of a setting from the front of `rest` and returns this part. `rest` is the value of an
// option without the parts of previous settings.
std::optional<std::string> take_part(const Setting& setting, std::optional<std::string>& rest) {
  std::optional<std::string> part = std::exchange(rest, std::nullopt);
  const std::size_t colon = part && !setting.part.last ? part->find(':') : std::string::npos;
  if (colon == std::string::npos) return part;
  rest = part->substr(colon + 1);
  part->resize(colon);
  return part;
}

}  // namespace

SettingName option_names(bool stream) {
  return [stream](std::string_view key) {
    std::string name(key);
    const StreamConfig any;
    visit_stream(any, [&](const Setting& setting, const auto&) {
      if (setting.key == key && has_option(setting, stream)) name = option_of(setting);
    });
    return name;
  };
}

SettingOptions::SettingOptions(CommandLine& line, const StreamConfig& defaults, bool stream)
    : line_(line), defaults_(defaults), stream_(stream) {
  line.option("--preset", preset_, "NAME", "Preset of settings: road, indoor or table");
  line.option("--config", file_, "FILE.yaml", "Settings; options override them");
  line.flag("--print-config", print_config_, "Print the settings that would be used, as such a file");
  line.option("--drop-inside", dropped_, "FILE.json",
              "Drop points inside the volumes of this result; repeatable");
  line.option("--keep-inside", cropped_, "FILE.json",
              "Drop points outside all volumes of this result; repeatable");
  line.option("--padding", padding_, "M", "Inflate the volumes of --drop-inside, --keep-inside by this (0)");
  const auto declare = [&](const Setting& setting, const auto& value) {
    if (!has_option(setting, stream_)) return;
    if constexpr (std::is_same_v<decltype(value), const bool&>) {
      line.flag(setting.option.data(), flags_[setting.option], std::string(setting.help));
    } else if (!setting.placeholder.empty()) {
      line.option(setting.option.data(), texts_[setting.option], setting.placeholder.data(),
                  help_of(setting.option, defaults_));
    }
  };
  visit_stream(defaults, declare);
}

void SettingOptions::apply(StreamConfig& config) const {
  std::map<std::string_view, std::optional<std::string>> rest(texts_.begin(), texts_.end());
  const auto read = [&](const Setting& setting, auto& value) {
    if (!has_option(setting, stream_) || !line_.given(setting.option.data())) return;
    if constexpr (std::is_same_v<decltype(value), bool&>) {
      value = true;
    } else {
      const auto part = take_part(setting, rest.at(setting.option));
      if (!part && !setting.part.optional)
        reject_value(setting.option, texts_.at(setting.option), "lacks :" + std::string(setting.part.name));
      parse_with(option_of(setting), part.value_or("0"),
                 [&](const std::string& text) { read_setting(setting, text, value); });
    }
    if constexpr (std::is_same_v<decltype(value), std::vector<std::string>&>) keep_first_mentions(value);
  };
  visit_stream(config, read);
  FilterConfig& filter = config.pipeline.filter;
  if (!dropped_.empty() || !cropped_.empty()) filter.regions.clear();
  for (const auto& [files, keep] : {std::pair(&dropped_, false), {&cropped_, true}}) {
    for (const std::string& file : *files)
      filter.regions.push_back({file, keep});
  }
  for (RegionConfig& region : filter.regions) {
    if (line_.given("--padding"))
      parse_with("--padding", padding_, [&](const std::string& text) { read_text(text, region.padding); });
    if (line_.given("--padding") && !(region.padding >= 0 && region.padding <= kMaxPadding))
      reject_value("--padding", padding_, "is not a length from 0 to 1e100");
  }
}

void SettingOptions::reject_useless(const PipelineConfig& config) const {
  const auto reject = [&](const char* option, bool useful, const char* needed) {
    detail::reject_useless({{option, line_.given(option), useful, needed}});
  };
  const bool clusters = config.cluster.tolerance > 0 || line_.given("--cluster");
  reject("--padding", !config.filter.regions.empty(), "--drop-inside or --keep-inside");
  if (!stream_ && line_.given("--refine") && config.cluster.refine == Refine::tracks)
    reject_value("--refine", "tracks", "needs the tracks of a stream; here it is auto, off or neck");
  const bool ground = config.ground.method != GroundMethod::none || line_.given("--ground");
  for (const char* option : {"--min-size", "--max-size", "--min-points", "--oversized", "--refine", "--class",
                             "--min-extent", "--max-extent"})
    reject(option, clusters, "--cluster");
  reject("--sensor", config.ground.method == GroundMethod::zones, "--ground zones");
  reject("--ground-cell", config.ground.method == GroundMethod::slope, "--ground slope");
  reject("--sensor-height", ground && config.ground.method != GroundMethod::slope,
         ground ? "--ground zones or plane" : "--ground");
  for (const char* option : {"--ground-distance", "--ground-slope"})
    reject(option, ground, "--ground");
}

StreamConfig SettingOptions::config(std::string* range_from) const {
  StreamConfig config = defaults_;
  std::string from = "the default; see --range";
  if (line_.given("--preset")) {
    parse_with("--preset", preset_, [&](const std::string& name) { apply_preset(name, config.pipeline); });
    from = "--preset " + preset_;
  }
  try {
    const auto range = range_limits(config);
    if (line_.given("--config")) config = read_stream_config(file_, config);
    if (range_limits(config) != range) from = "--config " + file_;
  } catch (const ConfigError& error) {
    throw UsageError(error.what());
  }
  apply(config);
  if (range_from != nullptr) *range_from = line_.given("--range") ? "--range" : from;
  reject_useless(config.pipeline);
  const SettingName name = option_names(stream_);
  const std::vector<ConfigProblem> problems = problems_of(config, name);
  if (!problems.empty()) throw UsageError(name(problems.front().key) + ": " + problems.front().what);
  for (const std::string& line : config.pipeline.ineffective_settings(name))
    report_problem(line);
  return config;
}

}  // namespace pcl_bv::detail
