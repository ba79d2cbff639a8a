// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Ground removal from the command line.

#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "command.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

using testing::HasSubstr;

// A floor 20 x 20 m at height -1.5 and two blocks of 27 points that stand on it, the axes turned as `order`
// says.
std::vector<std::string> floor_and_two_blocks(const std::string& order = "xyz", int sign = 1) {
  std::vector<std::string> points;
  const auto add = [&](double x, double y, double z) {
    const std::map<char, double> value = {{'x', x}, {'y', y}, {'z', sign * z}};
    std::string line;
    for (const char axis : order)
      line += std::to_string(value.at(axis)) + " ";
    points.push_back(line);
  };
  for (int i = 0; i < 41; ++i) {
    for (int j = 0; j < 41; ++j)
      add(-10 + 0.5 * i, -10 + 0.5 * j, -1.5);
  }
  for (const double x : {2.0, -4.0}) {
    for (int i = 0; i < 27; ++i)
      add(x + 0.3 * (i % 3), 3 + 0.3 * (i / 3 % 3), -1.2 + 0.3 * (i / 9));
  }
  return points;
}

TEST_F(PcdBv, WithoutGroundRemovalTheFloorJoinsEverything) {
  const std::string cloud = ascii("floor.pcd", floor_and_two_blocks());
  const Json report = run({"--cluster", "0.6", "--format", "jsonl", cloud}).json();
  ASSERT_EQ(report["clusters"].size(), 1u);
  EXPECT_EQ(report["clusters"][0]["points"], 41 * 41 + 54);
}

TEST_F(PcdBv, GroundIsCountedLabelledAndNotInTheClusters) {
  const std::string cloud = ascii("floor.pcd", floor_and_two_blocks());
  const Result result =
      run({"--ground", "plane", "--cluster", "0.6", "--format", "jsonl", "--labels", at("l.pcd"), cloud});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json report = result.json();
  EXPECT_EQ(report["counts"]["ground"], 41 * 41);
  ASSERT_EQ(report["clusters"].size(), 2u);
  EXPECT_EQ(report["clusters"][0]["points"], 27);
  EXPECT_EQ(report["clusters"][1]["points"], 27);
  const RawCloud labelled = read_pcd(at("l.pcd"));
  const PointField* field = find_field(labelled, "label");
  ASSERT_NE(field, nullptr);
  std::map<std::uint32_t, int> count;
  for (std::size_t i = 0; i < labelled.size(); ++i) {
    std::uint32_t label = 0;
    std::memcpy(&label, labelled.data.data() + i * labelled.point_step + field->offset, 4);
    ++count[label];
  }
  EXPECT_EQ(count, (std::map<std::uint32_t, int>{{0, 27}, {1, 27}, {4294967294, 41 * 41}}));
}

TEST_F(PcdBv, GroundIsTakenFromASingleEntryToo) {
  const std::string cloud = ascii("floor.pcd", floor_and_two_blocks());
  const Json report = run({"--ground", "plane", "--volume", "aabb", "--format", "jsonl", cloud}).json();
  ASSERT_EQ(report["clusters"].size(), 1u);
  EXPECT_EQ(report["clusters"][0]["points"], 54);
}

TEST_F(PcdBv, UpSaysWhereTheGroundIs) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
      {"z", floor_and_two_blocks("xyz")}, {"-z", floor_and_two_blocks("xyz", -1)},
      {"y", floor_and_two_blocks("xzy")}, {"-y", floor_and_two_blocks("xzy", -1)},
      {"x", floor_and_two_blocks("zyx")}, {"-x", floor_and_two_blocks("zyx", -1)},
      {"0,0,2", floor_and_two_blocks()},  {"-0.5,0.01,0", floor_and_two_blocks("zyx", -1)},
  };
  for (const auto& [up, points] : cases) {
    SCOPED_TRACE(up);
    const std::string cloud = ascii("turned.pcd", points);
    for (const std::string kind : {"plane", "zones", "slope"}) {
      const Json report =
          run({"--ground", kind, "--up", up, "--cluster", "0.6", "--format", "jsonl", cloud}).json();
      EXPECT_EQ(report["counts"]["ground"], 41 * 41);
      EXPECT_EQ(report["clusters"].size(), 2u);
    }
  }
}

TEST_F(PcdBv, ASensorHeightThatFitsNoPlaneLeavesTheCloudWhole) {
  const std::string cloud = ascii("floor.pcd", floor_and_two_blocks());
  const auto ground = [&](const char* height) {
    return run({"--ground", "plane", "--sensor-height", height, "--format", "jsonl", cloud})
        .json()["counts"]["ground"];
  };
  EXPECT_EQ(ground("1.5"), 41 * 41);
  EXPECT_EQ(ground("30"), 0);
}

TEST_F(PcdBv, ZonesFollowARoadThatClimbs) {
  std::vector<std::string> points;
  for (int i = -80; i <= 80; ++i) {
    for (int j = -20; j <= 20; ++j) {
      const double x = 0.5 * i, y = 0.5 * j;
      points.push_back(std::to_string(x) + " " + std::to_string(y) + " " +
                       std::to_string(-1.5 + 0.1 * std::max(0.0, x - 12)));
    }
  }
  const std::string cloud = ascii("climb.pcd", points);
  const auto ground = [&](const char* kind) {
    return run({"--ground", kind, "--sensor-height", "1.6", "--format", "jsonl", cloud})
        .json()["counts"]["ground"]
        .get<std::size_t>();
  };
  EXPECT_LT(ground("plane"), points.size() * 9 / 10);
  EXPECT_GE(ground("zones"), points.size() * 98 / 100);
}

TEST_F(PcdBv, BadGroundValuesAreWrongUse) {
  const std::string cloud = ascii("floor.pcd", {"1 2 3"});
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--ground", "plane", "--up", "w"}, "--up: up is 'w', must be x, y, z, -x, -y, -z or X,Y,Z"},
      {{"--ground", "plane", "--up", "0,0,0"}, "--up: up is '0,0,0'"},
      {{"--up", "y"}, "--up: only useful with --ground, --image or an upright box"},
      {{"--sensor-height", "1.7"}, "--sensor-height: only useful with --ground"},
      {{"--ground", "plane", "--sensor-height", "-1"}, "--sensor-height: -1 is not at least 0 and finite"},
      {{"--ground", "plane", "--sensor-height", "nan"}, "--sensor-height: nan is not at least 0"},
      {{"--ground", "magic"}, "--ground: 'magic' is not one of none, plane, zones, slope"},
  };
  for (auto [arguments, reason] : cases) {
    SCOPED_TRACE(reason);
    arguments.push_back(cloud);
    const Result result = run(arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.error_lines(), 1u);
    EXPECT_THAT(result.err, HasSubstr(reason));
  }
}

}  // namespace
}  // namespace pcl_bv::test
