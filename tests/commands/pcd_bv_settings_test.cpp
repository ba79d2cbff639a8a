// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files of settings, presets, origins, and what is said before results are believed.

#include <gmock/gmock.h>

#include <algorithm>

#include "command.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

using testing::HasSubstr;
using testing::Not;

TEST_F(PcdBv, PrintedSettingsGiveTheSameRun) {
  const std::vector<std::string> options{"--range",   "1:30",       "--ground",       "zones",
                                         "--cluster", "0.4",        "--min-size",     "20",
                                         "--volume",  "aabb,dop14", "--ground-slope", "12"};
  std::vector<std::string> print = options, direct = options;
  print.emplace_back("--print-config");
  const Result printed = run(print);
  ASSERT_EQ(printed.status, 0) << printed.err;
  for (const char* argument : {"--format", "jsonl", "synth:street:20000:3"})
    direct.emplace_back(argument);
  const Result from_file =
      run({"--config", file("run.yaml", printed.out), "--format", "jsonl", "synth:street:20000:3"});
  EXPECT_EQ(from_file.status, 0) << from_file.err;
  EXPECT_EQ(from_file.out, run(direct).out);
  EXPECT_EQ(from_file.json()["clusters"][0]["volumes"][1]["method"], "dop14");
}

TEST_F(PcdBv, OptionsWinOverTheFileAndTheFileOverThePreset) {
  const std::string yaml = file("a.yaml", "cluster: {tolerance: 0.3}\nvolumes: [dop6]\n");
  const std::string out =
      run({"--preset", "indoor", "--config", yaml, "--volume", "dop26", "--print-config"}).out;
  EXPECT_THAT(out, HasSubstr("tolerance: 0.3 "));
  EXPECT_THAT(out, HasSubstr("volumes: [dop26]"));
  EXPECT_THAT(out, HasSubstr("method: plane"));
}

TEST_F(PcdBv, ClustersGetOneUprightBoxUnlessAskedOtherwise) {
  const Json report = run({"--preset", "road", "--format", "jsonl", "synth:street:20000:3"}).json();
  ASSERT_GT(report["clusters"].size(), 3u);
  for (const Json& cluster : report["clusters"]) {
    ASSERT_EQ(cluster["volumes"].size(), 1u);
    EXPECT_EQ(cluster["volumes"][0]["method"], "obb-lshape");
  }
}

TEST_F(PcdBv, RegionsOfAnEarlierResultAreDroppedOrKept) {
  const std::string cloud =
      ascii("two.pcd", {"1 0 0", "1.5 0 0", "1 0.5 0.25", "9 0 0", "9.5 0 0", "9 0.5 0.3"});
  const std::string near = ascii("near.pcd", {"1 0 0", "1.5 0 0", "1 0.5 0.25"});
  const std::string found = file("near.json", run({"--volume", "sphere", "--format", "json", near}).out);
  const Json dropped = run({"--drop-inside", found, "--volume", "aabb", "--format", "jsonl", cloud}).json();
  EXPECT_EQ(dropped["counts"]["inside"], 3);
  EXPECT_EQ(dropped["clusters"][0]["volumes"][0]["min"], Json({9.0, 0.0, 0.0}));
  const Json kept = run({"--keep-inside", found, "--volume", "aabb", "--format", "jsonl", cloud}).json();
  EXPECT_EQ(kept["clusters"][0]["volumes"][0]["max"], Json({1.5, 0.5, 0.25}));
  const Json grown = run({"--drop-inside", found, "--padding", "10", "--format", "jsonl", "--min-size", "1",
                          "--cluster", "1", cloud})
                         .json();
  EXPECT_EQ(grown["counts"]["inside"], 6);
  EXPECT_EQ(run({"--drop-inside", at("none.json"), cloud}).status, 1);
  EXPECT_EQ(run({"--padding", "1", cloud}).status, 2);
  EXPECT_EQ(run({"--drop-inside", found, "--padding", "-1", cloud}).status, 2);
}

TEST_F(PcdBv, AnOriginIsSubtractedFirstAndNamed) {
  const std::string far = ascii("far.pcd", {"1001 2001 0", "1003 2002 0.5"});
  const Json moved = run({"--origin", "1000,2000,0", "--volume", "aabb", "--range", "0:5", "--format",
                          "jsonl", "--labels", at("l.pcd"), far})
                         .json();
  EXPECT_EQ(moved["origin"], Json({1000.0, 2000.0, 0.0}));
  EXPECT_EQ(moved["counts"]["range"], 0);
  EXPECT_EQ(moved["clusters"][0]["volumes"][0]["min"], Json({1.0, 1.0, 0.0}));
  EXPECT_EQ(moved["clusters"][0]["volumes"][0]["max"], Json({3.0, 2.0, 0.5}));
  const RawCloud labelled = read_pcd(at("l.pcd"));  // as it was stored
  EXPECT_EQ(load_point(labelled.xyz(), 0).x, 1001);
  const Result automatic = run({"--origin", "auto", "--volume", "aabb", far});
  EXPECT_THAT(automatic.out, HasSubstr("origin 1002 2002 0 subtracted from coordinates\n"));
  EXPECT_EQ(run({"--origin", "1,2", far}).status, 2);
  EXPECT_EQ(run({"--origin", "1,2,inf", far}).status, 2);
}

TEST_F(PcdBv, AnOriginKeepsDoublesThatFloatsWouldLose) {
  const std::string utm = file("utm.pcd",
                               "VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\n"
                               "WIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n"
                               "5000000.125 400000.25 100\n5000000.25 400000.5 100.5\n");
  const Json report = run({"--origin", "auto", "--cluster", "1", "--min-size", "1", "--volume", "aabb",
                           "--format", "jsonl", "--check", utm})
                          .json();
  const Json& box = report["clusters"][0]["volumes"][0];
  EXPECT_EQ(box["max"][0].get<double>() - box["min"][0].get<double>(), 0.125);
  EXPECT_EQ(box["outside"], 0);
}

TEST_F(PcdBv, FloatsFarFromTheirOriginAreRemarkedOn) {
  const std::string far = ascii("far.pcd", {"500000 5000000 0", "500010 5000002 1"});
  EXPECT_THAT(run({far}).err, HasSubstr("far.pcd: float32 coordinates near 5e+06 have a resolution of 0.5"));
  const std::string near = ascii("near.pcd", {"5000 5000 0", "5010 5002 1"});
  EXPECT_EQ(run({near}).err, "");
}

TEST_F(PcdBv, AGroundThatIsNotThereIsRemarkedOn) {
  std::vector<std::string> points;
  for (int i = 0; i < 120; ++i)
    points.push_back("3 " + std::to_string(0.1 * (i % 10)) + ' ' + std::to_string(0.1 * (i / 10)));
  const std::string wall = ascii("wall.pcd", points);
  const Result result = run({"--ground", "plane", "--cluster", "3", "--min-size", "1", wall});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, HasSubstr("wall.pcd: no ground found (up is z): try --up"));
}

TEST_F(PcdBv, BestSaysWhichShapeItIsInTextAndCsv) {
  const std::string cube =
      ascii("cube.pcd", {"0 0 0", "1 0 0", "0 1 0", "1 1 0", "0 0 1", "1 0 1", "0 1 1", "1 1 1"});
  EXPECT_THAT(run({"--volume", "best", cube}).out, HasSubstr("best (aabb)"));
  EXPECT_THAT(run({"--volume", "best", "--format", "csv", cube}).out, HasSubstr(",best (aabb),"));
}

TEST_F(PcdBv, FilesOfOtherFormatsAreNamedForWhatTheyAre) {
  const std::pair<const char*, const char*> cases[] = {{"a.obj", "is a mesh"},
                                                       {"a.e57", "scanner's own format"},
                                                       {"a.bag", "is no recording that can be read"},
                                                       {"a.csv", "no line of numbers"}};
  for (const auto& [name, said] : cases) {
    const Result result = run({file(name, "v 1 2 3\n")});
    EXPECT_EQ(result.status, 1) << name;
    EXPECT_THAT(result.err, HasSubstr(said)) << name;
    EXPECT_EQ(result.error_lines(), 1u) << result.err;
  }
}

TEST_F(PcdBv, TheTablePresetFindsWhatStandsOnATable) {
  const char* data = std::getenv("PCL_BV_DATA");
  if (data == nullptr) GTEST_SKIP() << "no PCL_BV_DATA";
  const std::string table = std::string(data) + "/organized/milk_cartoon_all_small_clorox.pcd";
  const Json report = run({"--preset", "table", "--check", "--format", "jsonl", table}).json();
  // A cartoon of milk, a small one and a bottle: 20 to 25 cm high.
  for (std::size_t i = 0; i < 3; ++i) {
    const Json& cluster = report["clusters"][i];
    EXPECT_GT(cluster["points"], 5000);
    const Json& half = cluster["volumes"][0]["half_extents"];
    const double size = 2 * std::max({half[0].get<double>(), half[1].get<double>(), half[2].get<double>()});
    EXPECT_GT(size, 0.15);
    EXPECT_LT(size, 0.3);
    EXPECT_EQ(cluster["volumes"][0]["outside"], 0);
  }
  EXPECT_LT(report["clusters"][3]["points"], 2000);
}

}  // namespace
}  // namespace pcl_bv::test
