// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/frame_sink.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "pcl_bv/nodes/frame_pipeline.h"
#include "pipeline/config/settings.h"
#include "stream/remote_parameters.h"

namespace pcl_bv::detail {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

struct Remote {
  Json values() const { return Json::parse(settings->values()); }
  FramePipeline pipeline;
  std::shared_ptr<RemoteParameters> settings = remote_settings(pipeline);
};

TEST(RemoteParameters, DescribeEverySettingOfThePipelineAndHaveItsValue) {
  const Remote remote;
  std::set<std::string> keys, described;
  PipelineConfig config;
  visit_pipeline(config, [&](const Setting& setting, const auto&) { keys.emplace(setting.key); });
  const Json values = remote.values();
  for (const Json& setting : Json::parse(remote.settings->description())) {
    described.insert(setting.at("key").get<std::string>());
    const std::set<std::string> kinds{"number", "count", "bool", "choice", "text"};
    EXPECT_TRUE(kinds.contains(setting.at("kind").get<std::string>())) << setting;
    EXPECT_TRUE(values.contains(setting.at("key").get<std::string>())) << setting;
    EXPECT_EQ(setting["kind"] == "choice", setting.contains("choices")) << setting;
    EXPECT_NE(setting.value("choices", Json::array({1, 2})).size(), 1U) << setting;
  }
  EXPECT_EQ(described, keys);
  EXPECT_EQ(values.size(), keys.size());
  EXPECT_EQ(values["cluster.tolerance"], 0.5);
  EXPECT_EQ(values["cluster.max_size"], "unlimited");
  EXPECT_EQ(values["filter.range_max"], "inf");
  EXPECT_EQ(values["ground.sensor_height"], "null");
  EXPECT_EQ(values["ground.method"], "zones");
  EXPECT_EQ(values["track.enabled"], false);
}

TEST(RemoteParameters, HaveTheSettingsOfARigWhichAreFixed) {
  FramePipeline pipeline;
  StreamConfig stream;
  stream.runner.queue = 7;
  stream.rig.frame = "base_link";
  stream.rig.sensors = {{"/front", "", {}}};
  const auto settings = remote_settings(pipeline, stream);
  const Json values = Json::parse(settings->values());
  EXPECT_EQ(values["rig.frame"], "base_link");
  EXPECT_EQ(values["rig.fixed_frame"], "null");
  EXPECT_EQ(values["rig.sync_ms"], 50);
  EXPECT_THAT(values["rig.sensors"].get<std::string>(), HasSubstr("/front"));
  std::size_t fixed = 0;
  for (const Json& setting : Json::parse(settings->description()))
    if (setting["key"].get<std::string>().starts_with("rig.")) fixed += setting["fixed"] == true;
  EXPECT_EQ(fixed, 7U);
  EXPECT_EQ(settings->change(R"({"rig.frame": "odom"})"), "rig.frame: cannot be changed while frames come");
  EXPECT_EQ(settings->stream().runner.queue, 7U);
}

TEST(RemoteParameters, EveryValueThatTheyHaveCanBeSetAgain) {
  const Remote remote;
  const Json values = remote.values();
  for (const auto& [key, value] : values.items()) {
    const std::string problem = remote.settings->change(Json{{key, value}}.dump());
    const bool fixed = key == "filter.regions" || key == "cluster.class_field" || key == "cluster.classes";
    EXPECT_EQ(problem, fixed ? key + ": cannot be changed while frames come" : "") << key << ' ' << value;
  }
}

TEST(RemoteParameters, ChangeThePipelineAllOrNothing) {
  const Remote remote;
  const auto change = [&](const char* object) { return remote.settings->change(object); };
  EXPECT_EQ(
      change(R"({"cluster.tolerance":0.25,"ground.method":"plane","volumes":"aabb, dop14","ground.up":"0,0,2",
                      "track.enabled":true,"cluster.min_size":"null","filter.own_box_min":[-1,-1,-1],
                      "filter.own_box_max":[1,1,1],"cluster.max_extent":[12,"unlimited",4.5]})"),
      "");
  const PipelineConfig config = remote.pipeline.config();
  EXPECT_EQ(config.cluster.tolerance, 0.25);
  EXPECT_EQ(config.ground.method, GroundMethod::plane);
  EXPECT_EQ(config.volumes, (std::vector<std::string>{"aabb", "dop14"}));
  EXPECT_TRUE(config.track.enabled);
  EXPECT_EQ(*config.filter.own_box_min, Eigen::Vector3d(-1, -1, -1));
  EXPECT_EQ(config.cluster.max_extent->up, 4.5);
  EXPECT_EQ(change(R"({"cluster.min_points":3,"cluster.tolerance":-1})"),
            "cluster.tolerance: -1 is not at least 0 and at most 1e+06");
  EXPECT_EQ(remote.pipeline.config().cluster.min_points, 1U);
}

TEST(RemoteParameters, RefuseWhatMakesNoSenseWithALine) {
  const Remote remote;
  const auto problem_of = [&](const char* object) { return remote.settings->change(object); };
  EXPECT_EQ(problem_of(R"({"cluster.toleranse":1})"), "cluster.toleranse: no such setting");
  EXPECT_EQ(problem_of(R"({"cluster.tolerance":"far"})"), "cluster.tolerance: 'far' is not a number");
  EXPECT_EQ(problem_of(R"({"cluster\n":1})"), "cluster?: no such setting");
  EXPECT_EQ(problem_of(R"({"cluster.tolerance":"\u001b[2J"})"), "cluster.tolerance: '?[2J' is not a number");
  EXPECT_THAT(problem_of(R"({"cluster.tolerance":{}})"), HasSubstr("is not a number"));
  EXPECT_THAT(problem_of(R"({"cluster.tolerance":null})"), HasSubstr("is not a number"));
  EXPECT_THAT(problem_of(R"({"ground.method":"sand"})"), HasSubstr("none, plane, zones"));
  EXPECT_THAT(problem_of(R"({"volumes":["aabb","cube"]})"), HasSubstr("'cube'"));
  EXPECT_THAT(problem_of(R"({"cluster.min_size":100,"cluster.max_size":10})"), HasSubstr("is below"));
  EXPECT_THAT(problem_of("[1]"), HasSubstr("not an object"));
  EXPECT_THAT(problem_of("{"), HasSubstr("not an object"));
  EXPECT_EQ(remote.values(), Remote().values());
}

}  // namespace
}  // namespace pcl_bv::detail
