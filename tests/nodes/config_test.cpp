// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "german_locale.h"
#include "pipeline/config/settings.h"

namespace pcl_bv::detail {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

std::string error_of(const std::string& yaml, const std::string& name = "robot.yaml") {
  try {
    parse_stream_config(yaml, name);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(StreamConfig, WithoutKeysIsTheDefault) {
  for (const char* text : {"", "{}", "# nothing\n", "filter:\n"})
    EXPECT_EQ(to_yaml(parse_stream_config(text, "")), to_yaml(StreamConfig())) << text;
  EXPECT_TRUE(StreamConfig().validate().empty());
}

TEST(StreamConfig, ErrorsWithoutAFileNameHaveNeitherNameNorLine) {
  EXPECT_THAT(error_of("\ncluster: {min_size: -1}", ""), testing::StartsWith("cluster.min_size: "));
  EXPECT_THAT(error_of("filter: {range_min: 5, range_max: 1}", ""),
              testing::StartsWith("filter.range_max: "));
  EXPECT_THAT(error_of("cluster: [", ""), testing::HasSubstr("invalid YAML"));
}

TEST(Settings, TheRangeOfAKeyThatDoesNotExistIsAnError) {
  EXPECT_EQ(range_of("ground.max_slope_degrees").max, 89);
  EXPECT_THROW(range_of("ground.max_slope"), std::logic_error);
}

TEST(StreamConfig, ReadsBackAsItIsPrinted) {
  StreamConfig config;
  config.pipeline.filter = {0.1, 123.456789012345, Eigen::Vector3d(-1, -2, -0.1), Eigen::Vector3d(1.5, 2, 3)};
  config.pipeline.ground = {
      GroundMethod::plane, {0.1, -1, 1.0 / 3}, Eigen::Vector3d(1, 2, 3.5), 1.0 / 3, 0.07, 12, 0.25};
  config.pipeline.cluster = {0.3, std::size_t{0}, 5000, 4, 0, Oversized::split, Refine::neck};
  config.pipeline.cluster.min_extent = {0.2, 0.1, 1.0 / 3};
  config.pipeline.cluster.max_extent = {12, std::numeric_limits<double>::infinity(), 4};
  config.pipeline.growth = SphereGrowth::stationary;
  config.pipeline.concave_length = 1.0 / 3;
  config.pipeline.deskew = Deskew::on;
  config.pipeline.filter.regions = {{"robot arm.json", false, 0.1}, {"hall.json", true, 0}};
  config.pipeline.volumes = {"dop26", "sphere-exact"};
  config.pipeline.track = {true, 1.25, 2, 9, true, true};
  config.pipeline.threads = 0;
  config.pipeline.isa = "scalar";
  config.runner = {7, QueuePolicy::block, 12.5, 3};
  config.rig.frame = "base \"link\"";
  config.rig.fixed_frame = "odom";
  config.rig.odometry = "/odom";
  config.rig.sync_ms = 1.0 / 3;
  config.rig.urdf = "my robot: a.urdf";
  config.rig.self_filter = 0.05;
  config.rig.sensors = {{"/front", "lidar", {1, 2, 3, 0.1, 1.0 / 3, 0}}, {"/rear", "", {}}};
  const std::string printed = to_yaml(config);
  const StreamConfig read = parse_stream_config(printed, "");
  EXPECT_EQ(to_yaml(read), printed);
  EXPECT_EQ(read.rig.frame, config.rig.frame);
  EXPECT_EQ(read.rig.odometry, config.rig.odometry);
  EXPECT_EQ(read.rig.urdf, config.rig.urdf);
  ASSERT_EQ(read.rig.sensors.size(), 2U);
  EXPECT_EQ(read.rig.sensors[0].pose, config.rig.sensors[0].pose);
  EXPECT_EQ(read.rig.sensors[0].frame, "lidar");
  EXPECT_EQ(read.pipeline.filter.range_max, 123.456789012345);
  EXPECT_EQ(read.pipeline.filter.own_box_max, Eigen::Vector3d(1.5, 2, 3));
  EXPECT_EQ(read.pipeline.ground.method, GroundMethod::plane);
  EXPECT_EQ(read.pipeline.ground.up, Eigen::Vector3d(0.1, -1, 1.0 / 3));
  EXPECT_EQ(read.pipeline.ground.sensor_height, 1.0 / 3);
  EXPECT_EQ(read.pipeline.ground.sensor, Eigen::Vector3d(1, 2, 3.5));
  EXPECT_EQ(read.pipeline.cluster.min_size, 0U);
  EXPECT_EQ(read.pipeline.cluster.max_size, 5000U);
  EXPECT_EQ(read.pipeline.cluster.min_points, 4U);
  EXPECT_EQ(read.pipeline.cluster.oversized, Oversized::split);
  EXPECT_EQ(read.pipeline.cluster.refine, Refine::neck);
  ASSERT_TRUE(read.pipeline.cluster.min_extent && read.pipeline.cluster.max_extent);
  EXPECT_EQ(read.pipeline.cluster.min_extent->up, 1.0 / 3);
  EXPECT_EQ(read.pipeline.cluster.max_extent->along, 12);
  EXPECT_EQ(read.pipeline.cluster.max_extent->across, std::numeric_limits<double>::infinity());
  EXPECT_EQ(read.pipeline.growth, SphereGrowth::stationary);
  EXPECT_EQ(read.pipeline.concave_length, 1.0 / 3);
  EXPECT_EQ(read.pipeline.deskew, Deskew::on);
  EXPECT_EQ(read.pipeline.method_options().concave_length, 1.0 / 3);
  ASSERT_EQ(read.pipeline.filter.regions.size(), 2U);
  EXPECT_EQ(read.pipeline.filter.regions[0].file, "robot arm.json");
  EXPECT_EQ(read.pipeline.filter.regions[0].padding, 0.1);
  EXPECT_TRUE(read.pipeline.filter.regions[1].keep);
  EXPECT_EQ(read.pipeline.volumes, config.pipeline.volumes);
  EXPECT_TRUE(read.pipeline.track.enabled);
  EXPECT_TRUE(read.pipeline.track.smooth);
  EXPECT_TRUE(read.pipeline.track.grow);
  EXPECT_EQ(read.runner.policy, QueuePolicy::block);
  EXPECT_EQ(read.runner.max_age_ms, 12.5);
}

TEST(StreamConfig, OnlyRoadsHaveVehicles) {
  for (const char* name : {"indoor", "road", "table"}) {
    StreamConfig config;
    apply_preset(name, config.pipeline);
    EXPECT_EQ(config.pipeline.track.vehicles, name == std::string("road")) << name;
    EXPECT_EQ(parse_stream_config(to_yaml(config), "").pipeline.track.vehicles,
              config.pipeline.track.vehicles);
  }
}

TEST(StreamConfig, AToleranceThatGrowsReadsBackAndGoesAlone) {
  StreamConfig config;
  config.pipeline.cluster.tolerance_per_metre = 0.015;
  EXPECT_EQ(parse_stream_config(to_yaml(config), "").pipeline.cluster.tolerance_per_metre, 0.015);
  config.pipeline.cluster.min_points = 5;
  EXPECT_EQ(
      config.pipeline.validate(),
      (std::vector<std::string>{
          "cluster.min_points: 5 is not allowed: must be 1 if cluster.tolerance_per_metre is above 0"}));
  config.pipeline.cluster = {0.0, std::size_t{1}, 100, 1, 0.01};
  EXPECT_EQ(
      config.pipeline.validate(),
      (std::vector<std::string>{
          "cluster.tolerance: 0 is not allowed: must be above 0 if cluster.tolerance_per_metre is above 0"}));
}

TEST(StreamConfig, AClassFieldReadsBackAndNeedsClusters) {
  for (const char* name : {"label", "a: b #c", "\"quoted\""}) {
    StreamConfig config;
    config.pipeline.cluster.class_field = FieldName{name};
    const auto read = parse_stream_config(to_yaml(config), "").pipeline.cluster.class_field;
    ASSERT_TRUE(read) << name;
    EXPECT_EQ(read->name, name);
  }
  PipelineConfig config;
  config.cluster.class_field = FieldName{""};
  EXPECT_EQ(config.validate(),
            std::vector<std::string>{"cluster.class_field: the name of the field is empty"});
  config.cluster = {0.0, std::size_t{1}};
  config.cluster.class_field = FieldName{"label"};
  EXPECT_EQ(
      config.validate(),
      (std::vector<std::string>{
          "cluster.class_field: needs a cluster.tolerance above 0: with 0, all points are one object"}));
}

TEST(StreamConfig, ClassesReadBackAsTheyArePrinted) {
  StreamConfig config;
  ClusterConfig& cluster = config.pipeline.cluster;
  cluster.class_field = FieldName{"label"};
  cluster.classes = {{-3, true}, {7, false, 0.3, std::size_t{4}, kUnlimited, {"obb", "sphere"}, "car"}, {9}};
  const std::string printed = to_yaml(config);
  EXPECT_THAT(printed, HasSubstr("classes: [{value: -3, drop: true}, {value: 7, drop: false, tolerance: 0.3, "
                                 "min_size: 4, max_size: unlimited, volumes: [obb, sphere], name: "
                                 "\"car\"}, {value: 9, drop: false}]"));
  const StreamConfig read = parse_stream_config(printed, "");
  EXPECT_EQ(to_yaml(read), printed);
  ASSERT_EQ(read.pipeline.cluster.classes.size(), 3U);
  EXPECT_TRUE(read.pipeline.cluster.classes[0].drop);
  EXPECT_EQ(read.pipeline.cluster.classes[1].value, 7);
  EXPECT_EQ(read.pipeline.cluster.classes[1].max_size, kUnlimited);
  EXPECT_EQ(read.pipeline.cluster.classes[1].volumes, (std::vector<std::string>{"obb", "sphere"}));
  EXPECT_EQ(read.pipeline.cluster.classes[1].name, "car");
  EXPECT_FALSE(read.pipeline.cluster.classes[2].tolerance);
}

TEST(StreamConfig, AClassThatIsNotAllowedIsNamedWithItsLine) {
  const std::pair<const char*, const char*> cases[] = {
      {"- {drop: true}", "line 4: cluster.classes: a class lacks the key 'value'"},
      {"- {value: car}", "line 4: cluster.classes: value: 'car' is not a whole number"},
      {"- value: 1\n    colour: red", "line 5: cluster.classes: unknown key 'colour' of a class"},
      {"- {value: 1, value: 2}", "line 4: cluster.classes: value: is given twice"},
      {"- {value: 1}\n  - {value: 2, tolerance: wide}",
       "line 5: cluster.classes: tolerance: 'wide' is not a number"},
      {"- 4", "line 4: cluster.classes: '4' is not a class, {value: 4, tolerance: 0.5}"},
      {"- {value: 1, volumes: aabb}", "cluster.classes: volumes: 'aabb' is not a list of methods"},
      {"- {value: 1}\n  - {value: 1}", "cluster.classes: class 1 is given twice"},
      {"- {value: 1, tolerance: 0}", "cluster.classes: class 1: tolerance: 0 is not above 0"},
      {"- {value: 1, tolerance: 1e-50}",
       "class 1: tolerance: 1e-50 is too small: it becomes 0 as float32, the type of points; use at least "
       "1.4e-45"},
      {"- {value: 1, max_size: 0}", "class 1: max_size: 0 is not a whole number of at least 1"},
      {"- {value: 1, max_size: 5}", "class 1: max_size, 5, is below min_size, 10"},
      {"- {value: 1, volumes: [box]}", "class 1: volumes: 'box' is no method; known are aabb"},
  };
  for (const auto& [rows, expected] : cases) {
    const std::string error = error_of("cluster:\n  class_field: label\n  classes:\n  " + std::string(rows));
    EXPECT_THAT(error, HasSubstr("robot.yaml: line ")) << rows;
    EXPECT_THAT(error, HasSubstr(expected)) << rows;
  }
  EXPECT_EQ(error_of("cluster: {classes: [{value: 1}]}"),
            "robot.yaml: line 1: cluster.classes: needs cluster.class_field");
  EXPECT_EQ(error_of("cluster: {class_field: label, classes: {value: 1}}"),
            "robot.yaml: line 1: cluster.classes: the value is not a list of classes");
}

TEST(StreamConfig, FilesOfAnyNameReadBackAsTheyArePrinted) {
  const std::string names[] = {R"(a "robot" arm.json)", R"(C:\new\x41\)", "it's {a, b}: #1.json",
                               "two\nlines\t.json",     "\x01 \x1f",      "\u00e4.json"};
  for (const std::string& name : names) {
    StreamConfig config;
    config.pipeline.filter.regions = {{name, true, 0.5}, {"next.json"}};
    const std::vector<RegionConfig> read = parse_stream_config(to_yaml(config), "").pipeline.filter.regions;
    ASSERT_EQ(read.size(), 2U) << name;
    EXPECT_EQ(read[0].file, name);
    EXPECT_EQ(read[0].padding, 0.5);
    EXPECT_EQ(read[1].file, "next.json");
  }
}

TEST(StreamConfig, RegionsWithoutAFileDoNotReadBack) {
  StreamConfig config;
  config.pipeline.filter.regions = {{"", false, 0, {Aabb()}}};
  EXPECT_THROW(parse_stream_config(to_yaml(config), ""), ConfigError);
}

TEST(StreamConfig, OtherKeysKeepTheirDefaults) {
  const StreamConfig config = parse_stream_config("filter: {range_min: 2}\nrunner:\n  queue: 4\n", "");
  EXPECT_EQ(config.pipeline.filter.range_min, 2);
  EXPECT_EQ(config.runner.queue, 4U);
  EXPECT_EQ(config.pipeline.cluster.tolerance, ClusterConfig().tolerance);
}

TEST(StreamConfig, KeysThatAreNotThereHaveTheGivenDefaults) {
  StreamConfig defaults;
  defaults.runner.policy = QueuePolicy::block;
  defaults.pipeline.threads = 0;
  EXPECT_EQ(parse_stream_config("cluster: {tolerance: 0.4}", "", defaults).runner.policy, QueuePolicy::block);
  EXPECT_EQ(parse_stream_config("threads: 3", "", defaults).pipeline.threads, 3U);
}

TEST(StreamConfig, AnUnknownKeyIsNamedWithItsLine) {
  EXPECT_EQ(error_of("threads: 2\nfilter:\n  range_min: 1\n  rangemax: 3\n"),
            "robot.yaml: line 4: unknown key 'filter.rangemax'");
  EXPECT_EQ(error_of("\ncolour: red\n"), "robot.yaml: line 2: unknown key 'colour'");
  EXPECT_EQ(error_of("extra:\n  nested: 1\n"),
            "robot.yaml: line 1: unknown key 'extra', or a key without nested keys");
}

TEST(StreamConfig, AnErrorIsOneLineWhateverItQuotes) {
  EXPECT_EQ(error_of("\"a\\nb\": 1"), "robot.yaml: line 1: unknown key 'a?b'");
  EXPECT_THAT(error_of("threads: \"\\x1b[2J\\x7f\"", ""),
              testing::StartsWith("threads: '?[2J?' is not a whole number"));
  EXPECT_EQ(error_of("gr\u00f6\u00dfe: 1", ""), "unknown key 'gr\u00f6\u00dfe'");
  PipelineConfig config;
  config.volumes = {"aabb", "sphere\n"};
  EXPECT_THAT(config.validate(), testing::ElementsAre(HasSubstr("volumes: 'sphere?' is no method")));
}

TEST(StreamConfig, AnErrorKeepsTheEndsOfALongKey) {
  std::string key;
  while (key.size() < 100'000)
    key += "\u00e4";
  const std::string error = error_of("? " + key + "\n: 1", "");
  EXPECT_LE(error.size(), 200U);
  EXPECT_THAT(error, testing::StartsWith("unknown key '\u00e4"));
  EXPECT_THAT(error, HasSubstr("\u00e4...\u00e4"));
  EXPECT_THAT(error, testing::EndsWith("\u00e4'"));
}

TEST(StreamConfig, DoesNotDependOnTheLocale) {
  const std::string text =
      "filter: {range_min: 1.250, range_max: .inf}\nrunner: {queue: 1000}\nground: {distance: +0.5}\n";
  const std::string before = to_yaml(parse_stream_config(text, ""));
  EXPECT_THAT(before, HasSubstr("1.25"));
  const test::GermanLocale german;
  EXPECT_EQ(to_yaml(parse_stream_config(text, "")), before);
}

TEST(StreamConfig, AValueThatIsNotAllowedIsNamedWithItsLineAndTheRange) {
  const std::pair<const char*, const char*> cases[] = {
      {"filter: {range_min: -1}", "line 1: filter.range_min: -1 is not at least 0"},
      {"filter: {range_min: .nan}", "filter.range_min: nan is not at least 0"},
      {"filter: {range_min: .inf}", "filter.range_min: inf is not at least 0 and finite"},
      {"filter: {range_min: 5, range_max: 4}", "filter.range_max: 4 is below filter.range_min, 5"},
      {"filter: {own_box_min: [0, 0, 0]}", "filter.own_box_min: is set without the other corner"},
      {"filter: {own_box_min: [0, 0, 2], own_box_max: [1, 1, 1]}", "filter.own_box_max: is below"},
      {"filter: {own_box_min: [0, 0]}", "filter.own_box_min: '0,0' is not three numbers"},
      {"filter: {range_min: far}", "filter.range_min: 'far' is not a number (m)"},
      {"ground:\n  method: zone", "line 2: ground.method: 'zone' is not one of none, plane, zones, slope"},
      {"ground: {up: w}", "ground.up: "},
      {"ground: {max_slope_degrees: 90}", "is not at least 0 and at most 89"},
      {"ground: {distance: 0}", "ground.distance: 0 is not above 0"},
      {"cluster: {tolerance: -0.5}", "cluster.tolerance: -0.5 is not at least 0"},
      {"cluster: {min_size: -3}", "cluster.min_size: '-3' is not a whole number of at least 0 (points)"},
      {"cluster: {min_size: 20, max_size: 10}", "cluster.max_size: 10 is below cluster.min_size, 20"},
      {"cluster: {min_extent: 0.2}", "cluster.min_extent: '0.2' is not a list of three numbers or null"},
      {"cluster: {min_extent: [0.2, 0.2]}", "cluster.min_extent: '0.2,0.2' is not three numbers"},
      {"cluster: {min_extent: [0, high, 0]}", "cluster.min_extent: 'high' is not a number"},
      {"cluster: {min_extent: [0, 0, -1]}", "cluster.min_extent: up: -1 is not at least 0 and finite"},
      {"cluster: {min_extent: [.inf, 0, 0]}", "cluster.min_extent: along: inf is not at least 0 and finite"},
      {"cluster: {max_extent: [5, .nan, 3]}", "cluster.max_extent: '.nan' is not a number"},
      {"cluster: {max_extent: [5, 0, 3]}", "cluster.max_extent: across: 0 is not above 0"},
      {"cluster: {min_extent: [0, 0, 2], max_extent: [5, unlimited, 1.5]}",
       "cluster.max_extent: up: 1.5 is below cluster.min_extent, 2"},
      {"cluster: {tolerance: 0, min_extent: [0, 0, 2]}",
       "cluster.min_extent: needs a cluster.tolerance above 0: with 0, all points are one object"},
      {"filter: {regions: [{file: a.json, pad: 1}]}", "filter.regions: unknown key 'pad' of a region"},
      {"filter: {regions: [{keep: true}]}", "filter.regions: a region has neither a file nor volumes"},
      {"filter: {regions: [{file: a.json, padding: -1}]}", "filter.regions: padding: -1 is not at least 0"},
      {"filter: {regions: a.json}", "filter.regions: 'a.json' is not a list of regions"},
      {"growth: fast", "growth: 'fast' is not one of sequential, stationary, deferred"},
      {"ground: {up: [0, 0, 0]}", "ground.up: "},
      {"volumes: [aabb, boxes]", "volumes: 'boxes' is no method; known are aabb"},
      {"volumes: [aabb, aabb]", "volumes: 'aabb' is named twice"},
      {"volumes: aabb", "volumes: 'aabb' is not a list of methods"},
      {"track: {enabled: maybe}", "track.enabled: 'maybe' is not true or false"},
      {"track: {birth: 0}", "track.birth: 0 is not a whole number of at least 1"},
      {"threads: 2000", "threads: 2000 is not a whole number of at least 0 and at most 1024"},
      {"isa: mmx", "isa: "},
      {"runner: {queue: 0}", "runner.queue: 0 is not a whole number of at least 1"},
      {"runner: {policy: lossy}",
       "runner.policy: 'lossy' is not one of auto, drop_oldest, drop_newest, block"},
      {"runner: {max_age_ms: -2}", "runner.max_age_ms: -2 is not at least 0"},
      {"threads: 1\nthreads: 2", "line 2: threads: is given twice"},
      {"cluster: {min_size: 2}\ncluster: {max_size: 9}", "line 2: cluster: is given twice"},
      {"cluster.tolerance: 0.3", "line 1: unknown key 'cluster.tolerance'"},
      {"threads: {}", "line 1: unknown key 'threads'"},
      {"threads: 1\n---\nbogus: 1", "line 2: a second YAML document begins"},
      {"volumes: [obb, obb-min]", "volumes: 'obb-min' is named twice"},
      {"cluster: {tolerance: 1e-50}",
       "cluster.tolerance: 1e-50 is too small: it becomes 0 as float32, the type of points; use 0, or at "
       "least 1.4e-45"},
      {"track: {gate: 101}", "track.gate: 101 is not above 0 and at most 100"},
  };
  for (const auto& [yaml, expected] : cases) {
    EXPECT_THAT(error_of(yaml), HasSubstr(expected)) << yaml;
    EXPECT_THAT(error_of(yaml), HasSubstr("robot.yaml: line ")) << yaml;
  }
}

TEST(StreamConfig, AnEmptyListOfMethodsDependsOnWhetherThereAreClusters) {
  const auto names = [](const char* yaml) {
    std::vector<std::string_view> found;
    for (const Method* method : parse_stream_config(yaml, "").pipeline.methods())
      found.push_back(method->name);
    return found;
  };
  EXPECT_THAT(names("volumes: []"), testing::ElementsAre("obb-lshape"));
  EXPECT_THAT(names("cluster: {tolerance: 0}"), testing::ElementsAre("aabb", "sphere-exact", "obb-min"));
  EXPECT_THAT(names("volumes: [sphere, aabb]"), testing::ElementsAre("sphere-exact", "aabb"));
}

TEST(StreamConfig, UpIsAnAxisOrAnyVector) {
  EXPECT_EQ(parse_stream_config("ground: {up: -y}", "").pipeline.ground.up, Eigen::Vector3d(0, -1, 0));
  EXPECT_EQ(parse_stream_config("ground: {up: \"1, 2,3\"}", "").pipeline.ground.up, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(parse_stream_config("ground: {up: [1, 2, 3]}", "").pipeline.ground.up, Eigen::Vector3d(1, 2, 3));
}

TEST(Settings, EachHasAKeyOfItsOwnAndWhatToSayOfIt) {
  std::set<std::string_view> keys;
  std::set<std::pair<std::string_view, std::string_view>> options;
  const StreamConfig defaults;
  visit_stream(defaults, [&](const Setting& setting, const auto& value) {
    EXPECT_TRUE(keys.insert(setting.key).second) << setting.key;
    EXPECT_FALSE(setting.help.empty()) << setting.key;
    EXPECT_TRUE(setting.option.empty() || options.insert({setting.option, setting.part.name}).second)
        << setting.option;
    EXPECT_EQ(problem_of(setting, value), "") << setting.key;
    auto read = value;
    if (!to_text(value).empty()) read_text(to_text(value), read);
    EXPECT_EQ(to_text(read), to_text(value)) << setting.key;
  });
  EXPECT_GT(keys.size(), 20U);
}

TEST(Presets, AreAllowedAndNamedWhereTheyAreNot) {
  for (const char* name : {"road", "indoor", "table"}) {
    PipelineConfig config;
    apply_preset(name, config);
    EXPECT_THAT(config.validate(), testing::IsEmpty()) << name;
  }
  PipelineConfig config;
  EXPECT_THROW(apply_preset("sea", config), std::invalid_argument);
}

TEST(StreamConfig, TextThatIsNoYamlIsAnErrorWithItsLine) {
  EXPECT_THAT(error_of("filter:\n  - ]\n"), HasSubstr("robot.yaml: line 2: "));
  EXPECT_THAT(error_of("a: b: c"), HasSubstr("robot.yaml: line 1: "));
  EXPECT_THAT(error_of("[1, 2]"), HasSubstr("robot.yaml: line 1: "));
  EXPECT_THAT(error_of("filter: 3"), HasSubstr("robot.yaml: line 1: "));
}

TEST(StreamConfig, NestedWithoutEndIsAnErrorInOurWords) {
  const auto times = [](std::size_t count, const std::string& text) {
    std::string all;
    for (std::size_t i = 0; i < count; ++i)
      all += text;
    return all;
  };
  for (const std::size_t depth : {std::size_t{600}, std::size_t{100'000}}) {
    for (const std::string& text :
         {"a: " + times(depth, "["), "a: " + times(depth, "{a: "), times(depth, "- "), times(depth, "? ")})
      EXPECT_THAT(error_of(text), HasSubstr("nested more than 500 deep"));
  }
  EXPECT_THAT(error_of("a: " + times(100, "[") + times(100, "]")), HasSubstr("unknown key 'a'"));
  for (const char* text :
       {"filter:\n  - ]\n", "a: b: c", "\"", "? [a]\n: b", "*x", "!!x", "%YAML", "a: &", "[a, b"})
    EXPECT_THAT(error_of(text), Not(AnyOf(HasSubstr("bad "), HasSubstr("yaml-cpp"), HasSubstr("not found"))))
        << text;
  EXPECT_THAT(error_of(times(1'048'577, " ")), HasSubstr("has more than 1048576 bytes"));
}

// Of these texts yaml-cpp 0.7 reads empty documents without end.
TEST(StreamConfig, ACommaOutsideOfBracketsIsAnError) {
  for (const char* text : {",", ", a", "[a] ,", "{threads: 1},", "\"a\","})
    EXPECT_EQ(error_of(text), "robot.yaml: line 1: a second YAML document begins; only one is allowed")
        << text;
}

TEST(StreamConfig, AFileThatCannotBeReadIsAnError) {
  EXPECT_THROW(read_stream_config("/dev/zero"), ConfigError);
  EXPECT_THROW(read_stream_config("/nonexistent/robot.yaml"), ConfigError);
  EXPECT_THROW(read_stream_config("/tmp"), ConfigError);
}

}  // namespace
}  // namespace pcl_bv::detail
