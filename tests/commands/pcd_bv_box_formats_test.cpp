// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The formats of boxes, as data sets and labelling tools read them.

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

#include "command.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kScene = "synth:street:20000:2";
const std::vector<std::string> kObjects{"--range",   "1:30", "--ground", "zones",
                                        "--cluster", "0.5",  "--format"};

std::vector<std::string> objects(std::vector<std::string> rest) {
  rest.insert(rest.begin(), kObjects.begin(), kObjects.end());
  return rest;
}

TEST_F(PcdBv, FormatsOfBoxesHaveOneBoxForEachObject) {
  const std::size_t n = Json::parse(run(objects({"json", kScene})).out)[0]["clusters"].size();
  ASSERT_GT(n, 3U);
  const std::string kitti = run(objects({"kitti", "--object-type", "Car", kScene})).out;
  EXPECT_EQ(static_cast<std::size_t>(std::count(kitti.begin(), kitti.end(), '\n')), n);
  EXPECT_THAT(kitti, StartsWith("Car -1 -1 "));
  EXPECT_EQ(Json::parse(run(objects({"sustech", kScene})).out).size(), n);
  EXPECT_EQ(Json::parse(run(objects({"nuscenes", kScene})).out)["results"][kScene].size(), n);
  EXPECT_EQ(Json::parse(run(objects({"openlabel", kScene})).out)["openlabel"]["objects"].size(), n);
}

TEST_F(PcdBv, FormatsOfBoxesKeepSeveralInputsApart) {
  const std::string missing = at("missing.pcd");
  const std::string tracking = run(objects({"kitti-tracking", "synth:street:5000", missing, kScene})).out;
  EXPECT_THAT(tracking, StartsWith("0 -1 Misc "));
  EXPECT_THAT(tracking, HasSubstr("\n2 -1 Misc "));
  EXPECT_THAT(tracking, testing::Not(HasSubstr("\n1 ")));
  const Json results =
      Json::parse(run(objects({"nuscenes", missing, "synth:street:5000", kScene})).out)["results"];
  EXPECT_EQ(results.size(), 2U);
  const std::string both = run(objects({"openlabel", missing, "synth:street:5000", kScene})).out;
  const Json labels = Json::parse(both)["openlabel"]["objects"];
  EXPECT_EQ(labels.size(), results[kScene].size() + results["synth:street:5000"].size());
  EXPECT_EQ(Json::parse(run(objects({"nuscenes", missing})).out)["results"].size(), 0U);
}

TEST_F(PcdBv, FormatsOfBoxesRefuseWhatTheyWouldLose) {
  const auto error = [&](const std::vector<std::string>& arguments) {
    const Result result = run(arguments);
    EXPECT_EQ(result.status, 2);
    return result.err;
  };
  EXPECT_THAT(error(objects({"kitti", kScene, kScene})),
              HasSubstr("--format: files of kitti, sustech and 3D Tiles have one input, not 2"));
  EXPECT_THAT(error({"--format", "kitti", "--volume", "sphere,obb", kScene}), HasSubstr("needs boxes"));
  EXPECT_THAT(error({"--format", "openlabel", "--volume", "sphere", kScene}), HasSubstr("obb or aabb"));
  EXPECT_THAT(error({"--format", "kitti", "--volume", "obb-yaw", "--up", "-y", kScene}), HasSubstr("--up"));
  EXPECT_THAT(error({"--format", "sustech", "--origin", "auto", kScene}), HasSubstr("--origin"));
  EXPECT_THAT(error({"--format", "kitti", "--object-type", "a b", kScene}), HasSubstr("'a b'"));
  EXPECT_THAT(error({"--format", "3dtiles", "--volume", "hull", kScene}), HasSubstr("obb, aabb or sphere"));
  EXPECT_THAT(error({"--format", "3dtiles", "--origin", "auto", kScene}), HasSubstr("--origin"));
  EXPECT_THAT(error({"--object-type", "Car", kScene}), HasSubstr("only useful with a --format of boxes"));
}

TEST_F(PcdBv, FormatsOfBoxesRefuseMergedResultsWithAnOrigin) {
  ASSERT_EQ(run({"--partial", at("moved"), "--origin", "1,2,3", "synth:box:1000"}).status, 0);
  ASSERT_EQ(run({"--partial", at("same"), "--origin", "0,0,0", "synth:box:1000"}).status, 0);
  for (const std::string format : {"3dtiles", "3dtiles-region", "openlabel"}) {
    const auto merge = [&](const std::string& part) {
      return run({"--merge", "--format", format, "--volume", "aabb", at(part)});
    };
    const Result moved = merge("moved");
    EXPECT_EQ(moved.status, 1) << format;
    EXPECT_THAT(moved.err, HasSubstr("was made with --origin, which this format would lose")) << format;
    EXPECT_THAT(moved.out, testing::Not(HasSubstr("box"))) << format;
    EXPECT_EQ(merge("same").status, 0) << format << merge("same").err;
  }
}

TEST_F(PcdBv, BoxesOfEveryFormatDropThePointsInside) {
  for (const std::string format : {"kitti", "nuscenes", "openlabel", "sustech"}) {
    const std::string file = at("boxes." + format);
    ASSERT_EQ(run({"--format", format, "--volume", "aabb", "--output", file, "synth:box:1000"}).status, 0);
    const Result result =
        run({"--drop-inside", file, "--padding", "1e-6", "--format", "json", "synth:box:1000"});
    EXPECT_EQ(Json::parse(result.out)[0]["counts"]["inside"], 1000) << format << result.err;
  }
}

TEST_F(PcdBv, TilesetsAreUpdatedInTheirFiles) {
  const std::string tile = R"({"boundingVolume":{"sphere":[0,0,0,1]},"content":{"uri":"a.pnts"}})";
  const std::string set = R"({"root":)" + tile + "}";
  std::ofstream(at("tileset.json")) << set;
  const Result missing = run({"--update", at("tileset.json"), at("none.json")});
  EXPECT_EQ(missing.status, 1);
  EXPECT_EQ(missing.out, at("tileset.json") + ": 0 of 1 tiles updated\n");
  EXPECT_THAT(missing.err, HasSubstr("tileset.json: a.pnts: no such file or directory\n"));
  EXPECT_THAT(missing.err, HasSubstr("none.json: no such file or directory\n"));
  EXPECT_EQ(read_file(at("tileset.json")), set);
  const std::string table = R"({"POINTS_LENGTH":1,"POSITION":{"byteOffset":0}})";
  std::string header = "pnts";
  for (const std::size_t number :
       {std::size_t{1}, 40 + table.size(), table.size(), std::size_t{12}, std::size_t{0}, std::size_t{0}})
    for (int byte = 0; byte < 4; ++byte)
      header += static_cast<char>(number >> 8 * byte);
  std::ofstream(at("a.pnts"), std::ios::binary) << header << table << std::string(12, '\0');
  const Result done = run({"--update", at("tileset.json")});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(Json::parse(read_file(at("tileset.json")))["root"]["boundingVolume"]["sphere"][3], 0);
  EXPECT_EQ(run({"--update", "--format", "json", at("tileset.json")}).status, 2);
  EXPECT_THAT(run({"--update", "--volume", "sphere", at("tileset.json")}).err,
              HasSubstr("--update: needs a box"));
  const Json tiles = Json::parse(run(objects({"3dtiles", kScene})).out);
  EXPECT_GT(tiles["root"]["children"].size(), 3U);
  EXPECT_EQ(run(objects({"3dtiles", kScene, kScene})).status, 2);
}

TEST_F(PcdBv, GeographicCloudsHaveRegionsOf3dTiles) {
  std::ofstream(at("town.xyz")) << "x y z\n13.25 52.5 30\n13.5 52.25 35.5\n";
  const std::vector<std::string> regions{"--format", "3dtiles-region", "--volume", "aabb", at("town.xyz")};
  const Result result = run(regions);
  EXPECT_EQ(result.status, 0) << result.err;
  const Json tile = Json::parse(result.out)["root"]["children"][0];
  const auto region = tile["boundingVolume"]["region"].get<std::vector<double>>();
  const std::vector<double> degrees{13.25, 52.25, 13.5, 52.5};
  ASSERT_EQ(region.size(), 6U);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(region[i], degrees[i] / 180 * M_PI, 1e-15);
  EXPECT_EQ(region[5], 35.5);
  std::ofstream(at("town.xyz")) << "392000 5820000 30\n";  // UTM
  const Result utm = run(regions);
  EXPECT_EQ(utm.status, 1);
  EXPECT_EQ(utm.out, "");
  EXPECT_THAT(utm.err, HasSubstr("town.xyz: has the longitude 392000; allowed are -180 to 180 degrees"));
  EXPECT_THAT(run({"--format", "3dtiles-region", "--volume", "obb", kScene}).err,
              HasSubstr("--format 3dtiles-region: needs --volume aabb"));
  EXPECT_EQ(run({"--format", "3dtiles-region", "--volume", "aabb", kScene, kScene}).status, 2);
}

}  // namespace
}  // namespace pcl_bv::test
