// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A number is allowed or refused alike, and in the same words, however it comes: in a struct, a file, or from
// a page.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/nodes/frame_sink.h"
#include "pipeline/config/settings.h"
#include "stream/remote_parameters.h"

namespace pcl_bv::detail {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double kValues[] = {0, -1, NAN, INFINITY, 1e-300, 1e300};

template <typename T>
constexpr bool is_real = std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>>;
template <typename T>
constexpr bool is_count = std::is_same_v<T, std::size_t> || std::is_same_v<T, std::optional<std::size_t>>;

// What is said of each of the values for each setting that is a number, without its key; nothing if it is
// allowed alone (with others at their defaults it may still contradict them).
using Problems = std::map<std::string, std::map<std::string, std::string>>;

Problems by_problem_of() {
  Problems problems;
  StreamConfig config;
  visit_stream(config, [&](const Setting& setting, auto& value) {
    if constexpr (is_real<std::decay_t<decltype(value)>>) {
      for (const double v : kValues)
        problems[std::string(setting.key)][to_text(v)] = problem_of(setting, v);
    }
  });
  return problems;
}

std::string yaml_with(const std::string& key, const std::string& value) {
  const std::size_t dot = key.find('.');
  return dot == std::string::npos ? key + ": " + value
                                  : key.substr(0, dot) + ": {" + key.substr(dot + 1) + ": " + value + "}";
}

std::string yaml_number(const std::string& text) {
  return text == "nan" || text == "inf" ? '.' + text : text;
}

std::string file_problem(const std::string& key, const std::string& value) {
  try {
    parse_stream_config(yaml_with(key, yaml_number(value)), "f");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return {};
}

TEST(SettingValues, OfNumbersAreRefusedInTheSameWordsByStructFileAndPage) {
  FramePipeline pipeline;
  const auto remote = remote_settings(pipeline);
  for (const auto& [key, values] : by_problem_of()) {
    const bool of_pipeline = !key.starts_with("runner.") && !key.starts_with("rig.");
    for (const auto& [value, problem] : values) {
      SCOPED_TRACE(key + " = " + value);
      const std::string in_file = file_problem(key, value);
      const std::string from_page =
          of_pipeline ? remote->change(nlohmann::json{{key, value}}.dump()) : in_file;
      if (problem.empty()) {
        EXPECT_THAT(in_file, testing::Not(HasSubstr(value + " is not at least")));
        continue;
      }
      EXPECT_THAT(problem, AnyOf(StartsWith(value + " is not "), StartsWith(value + " is too small: ")));
      EXPECT_THAT(problem, AnyOf(HasSubstr("at least "), HasSubstr("above ")));
      EXPECT_THAT(in_file, testing::EndsWith(key + ": " + problem));
      EXPECT_THAT(from_page, testing::EndsWith(key + ": " + problem));
    }
  }
}

TEST(SettingValues, OfCountsAreRefusedWithTheirRange) {
  FramePipeline pipeline;
  const auto remote = remote_settings(pipeline);
  StreamConfig config;
  visit_stream(config, [&](const Setting& setting, auto& field) {
    if constexpr (is_count<std::decay_t<decltype(field)>>) {
      const std::string key(setting.key), least = to_text(static_cast<std::size_t>(setting.range.min));
      for (const char* value :
           {"0", "-1", "nan", "inf", "1e-300", "1e300", "0.5", "99999999999999999999999"}) {
        SCOPED_TRACE(key + " = " + value);
        if (std::string(value) == "0" && setting.range.min == 0) continue;
        const std::string range = " is not a whole number of at least " + least;
        EXPECT_THAT(file_problem(key, value), HasSubstr(range));
        if (key.rfind("runner.", 0) != 0) {
          EXPECT_THAT(remote->change(nlohmann::json{{key, value}}.dump()), HasSubstr(range));
        }
      }
    }
  });
}

TEST(SettingValues, AToleranceThatIsZeroAsAFloatIsRefusedLikeOthers) {
  EXPECT_EQ(file_problem("cluster.tolerance", "1e-300"),
            "f: line 1: cluster.tolerance: 1e-300 is too small: it becomes 0 as float32, the type of points; "
            "use 0, or at least 1.4e-45");
  EXPECT_THAT(file_problem("cluster.tolerance_per_metre", "1e-300"), HasSubstr("1e-300 is too small"));
  EXPECT_THAT(file_problem("cluster.classes", "[{value: 1, tolerance: 1e-300}]"),
              HasSubstr("tolerance: 1e-300 is too small: it becomes 0 as float32, the type of points; use at "
                        "least 1.4e-45"));
  EXPECT_EQ(file_problem("cluster.tolerance", "1.4e-45"), "");
}

}  // namespace
}  // namespace pcl_bv::detail
