// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/report/report.h"
#include "volume_files.h"

namespace pcl_bv::detail {
namespace {

using testing::HasSubstr;

class ReadVolumes : public VolumeFileTest {};

TEST_F(ReadVolumes, AreThoseOfTheReportBitByBit) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<double> xyz(3 * 200);
  for (double& coordinate : xyz)
    coordinate = 1e3 + normal(random) / 3;
  const PointView points = PointView::of(xyz.data(), 3 * sizeof(double), xyz.size() / 3);
  Report report;
  report.file = "a.pcd";
  report.clusters.resize(1);
  for (const Method& method : methods()) {
    VolumeEntry entry;
    entry.method = method.name;
    entry.volume = *method.fit(points);
    report.clusters[0].volumes.push_back(entry);
  }
  const std::vector<AnyVolume> found = read(report_json(report) + "\n" + report_json(report) + "\n");
  ASSERT_EQ(found.size(), 2 * methods().size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_TRUE(found[i] == report.clusters[0].volumes[i % methods().size()].volume) << i;
}

TEST_F(ReadVolumes, MayBeWrittenByHand) {
  const auto found = read(R"([{"shape":"sphere","center":[1,2,3],"radius":0.5},
                              {"shape":"aabb","min":[0,0,0],"max":[1,1,1]}, {"shape":"hull","empty":true}])");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_TRUE(found[0] == AnyVolume(Sphere({1, 2, 3}, 0.5)));
  EXPECT_TRUE(found[1] == AnyVolume(Aabb({0, 0, 0}, {1, 1, 1})));
}

TEST_F(ReadVolumes, SayWhatIsWrong) {
  EXPECT_THAT(error_of("{}"), HasSubstr("no volumes"));
  EXPECT_THAT(error_of("not json"), HasSubstr("volumes.json: "));
  EXPECT_THAT(error_of(R"({"shape":"blob"})"), HasSubstr("\"blob\" is no shape"));
  EXPECT_THAT(error_of(R"({"shape":"sphere","center":[1,2,3]})"), HasSubstr("radius"));
  EXPECT_THAT(error_of(R"({"shape":"sphere","center":[1,2],"radius":1})"), HasSubstr("three numbers"));
  EXPECT_THAT(error_of(R"({"shape":"sphere","center":[1,2,"x"],"radius":1})"), HasSubstr("volumes.json: "));
  EXPECT_THROW(read_volumes("/nonexistent.json"), IoError);
}

TEST_F(ReadVolumes, OutlinesOfPrismsAreSimplePolygons) {
  const auto prism = [](const std::string& outline) {
    return R"({"shape":"prism","axes":[[1,0,0],[0,1,0],[0,0,1]],"outline":)" + outline +
           R"(,"low":0,"high":2})";
  };
  EXPECT_EQ(read(prism("[[0,0],[1,0],[0,1]]")).front(),
            AnyVolume(Prism(Eigen::Matrix3d::Identity(), {{0, 0}, {1, 0}, {0, 1}}, 0, 2)));
  const std::string corner = "[[0,0],[4,0],[4,1],[1,1],[1,4],[0,4]]";
  EXPECT_EQ(
      read(prism(corner)).front(),
      AnyVolume(Prism(Eigen::Matrix3d::Identity(), {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}, 0, 2)));
  EXPECT_THAT(error_of(prism("[[0,0],[0,1],[1,0]]")), HasSubstr("counter-clockwise"));
  EXPECT_THAT(error_of(prism("[[0,0],[2,2],[2,0],[0,2]]")), HasSubstr("edges meet only at the corners"));
  EXPECT_THAT(error_of(prism("[[0,0,0]]")), HasSubstr("outline: two numbers"));
  EXPECT_THAT(error_of(prism("3")), HasSubstr("outline: a list"));
  EXPECT_THAT(error_of(prism("[]")), HasSubstr("empty"));
}

const std::string kBall = R"({"shape":"sphere","center":[0,0,0],"radius":1})";

TEST_F(ReadVolumes, ThatCannotBeReadAmongOthersAreRefusedByName) {
  const std::string bare = R"({"center":[5,5,5],"radius":1})";
  EXPECT_THAT(error_of("[" + kBall + "," + bare + "]"),
              HasSubstr("json: [1]: is no volume: it has no \"shape\""));
  EXPECT_THAT(error_of("[" + kBall + ",null]"), HasSubstr("[1]: is no volume: null"));
  EXPECT_THAT(error_of("[3," + kBall + "]"), HasSubstr("[0]: is no volume: 3"));
  EXPECT_THAT(error_of(R"({"volumes":[)" + bare + "]}"), HasSubstr("volumes[0]: is no volume"));
  EXPECT_THAT(error_of(kBall + R"({"volumes":null})"), HasSubstr("volumes: is no volume: null"));
  EXPECT_THAT(error_of(R"({"a\nb":{"volumes":null}})"), HasSubstr("a?b.volumes: is no volume: null"));
  EXPECT_THAT(error_of(R"({"volumes":{"arm":)" + kBall + R"(,"leg":7}})"),
              HasSubstr("volumes.leg: is no volume: 7"));
  EXPECT_THAT(error_of(R"({"arm":)" + kBall + R"(,"leg":)" + bare + "}"), HasSubstr("leg: is no volume"));
  EXPECT_THAT(
      error_of(R"({"clusters":[{"volumes":[)" + kBall + R"(]},{"volumes":[)" + kBall + "," + bare + "]}]}"),
      HasSubstr("clusters[1].volumes[1]: is no volume"));
  EXPECT_THAT(error_of(kBall + "\n" + bare + "\n"), HasSubstr("json: line 2, column 1: is no volume"));
  EXPECT_THAT(error_of("[" + kBall + R"(,{"shape":"sphere","centre":[0,0,0],"radius":1}])"),
              HasSubstr("[1]: has no \"center\""));
  EXPECT_THAT(error_of("[" + kBall + R"(,{"shape":"spere"}])"), HasSubstr("[1]: \"spere\" is no shape"));
  EXPECT_THAT(error_of(R"([{"shape":null}])"), HasSubstr("[0]: null is no shape"));
  EXPECT_THAT(error_of(R"([{"shape":"sphere","center":[0,0,0],"radius":"1"}])"),
              HasSubstr("[0]: radius: a number is wanted, not \"1\""));
  EXPECT_THAT(error_of(R"([{"shape":"sphere","center":[0,null,0],"radius":1}])"),
              HasSubstr("center: a number"));
  EXPECT_THAT(error_of(R"([{"shape":"sphere","center":[0,0,0],"radius":-1}])"),
              HasSubstr("the volume is empty"));
  EXPECT_THAT(error_of(R"([{"shape":"sphere","failed":"flat"}])"), HasSubstr("its fit failed"));
}

TEST_F(ReadVolumes, OfHullsNameVerticesThatExist) {
  const auto hull = [](const std::string& face) {
    return R"({"shape":"hull","vertices":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]],"faces":[)" + face +
           R"(],"planes":[[-1,0,0,0]]})";
  };
  EXPECT_EQ(read(hull("[0,1,2]")).size(), 1U);
  for (const char* face :
       {"[0,1,4]", "[0,1,-1]", "[0,1,4294967296]", "[0,1,1.5]", "[0,1]", "[0,1,\"2\"]", "7"})
    EXPECT_THAT(error_of(hull(face)), HasSubstr("faces: ")) << face;
  EXPECT_THAT(error_of(R"({"shape":"hull","vertices":[],"faces":[],"planes":[],"rank":9})"),
              HasSubstr("rank: "));
}

TEST_F(ReadVolumes, StandAmongNumbersTextsAndEmptyReports) {
  EXPECT_EQ(read(R"({"name":"robot","frame":7,"base":)" + kBall + "}").size(), 1U);
  EXPECT_EQ(read(R"({"schema":1,"clusters":[],"counts":{"range":0}})"
                 "\n"
                 R"({"file":"a","error":"b"})"
                 "\n"
                 R"({"clusters":[{"id":0,"pose":[1,2],"volumes":[)" +
                 kBall + "]}]}")
                .size(),
            1U);
  EXPECT_EQ(read("[[" + kBall + "],[" + kBall + "]]").size(), 2U);
  EXPECT_EQ(read("[" + kBall + R"(,{"shape":"aabb","empty":true}])").size(), 1U);
  EXPECT_THAT(error_of(R"([{"shape":"sphere","empty":false}])"), HasSubstr("has no"));
}

TEST_F(ReadVolumes, NestedWithoutEndAreAnErrorAndNoCrash) {
  for (const std::size_t depth : {std::size_t{65}, std::size_t{20'000}, std::size_t{1'000'000}}) {
    const std::string open(depth, '['), close(depth, ']');
    EXPECT_THAT(error_of(R"({"volumes":)" + open + close + "}"), HasSubstr("nested more than 64 deep"));
    EXPECT_THAT(error_of(R"({"volumes":)" + open), HasSubstr("nested more than 64 deep"));
    EXPECT_THAT(error_of("[" + kBall + "," + open + close + "]"), HasSubstr("nested more than 64 deep"));
  }
}

TEST_F(ReadVolumes, SpeakNoLibrarysWords) {
  for (const char* text :
       {"{", "[1e999]", "{\"shape\":1}", "\xff", "[", "nul", "{\"shape\":\"hull\",\"faces\":3}",
        "{\"shape\":\"kdop\",\"directions\":[[1,0,0]],\"min\":[1],\"max\":[\"\"]}"}) {
    EXPECT_THAT(error_of(text), testing::Not(HasSubstr("json.exception"))) << text;
    EXPECT_THAT(error_of(text), HasSubstr("volumes.json: ")) << text;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
