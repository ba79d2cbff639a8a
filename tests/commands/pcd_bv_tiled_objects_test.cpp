// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Objects of one cloud in many files: --together --cluster.

#include <gmock/gmock.h>

#include "tiled_objects.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;

using PcdBvTiledObjects = TiledObjects;

TEST_F(PcdBvTiledObjects, AreThoseOfOneFileForAnyTilesOptionsAndMemory) {
  const std::vector<std::vector<std::string>> options = {
      {"--cluster", "0.4", "--volume", "all,hull,best"},
      {"--cluster", "0.4", "--min-points", "5", "--min-size", "20", "--volume", "aabb,obb-lshape"},
      {"--cluster", "1.5", "--max-size", "3000", "--volume", "sphere-epos26"},
      {"--cluster", "1.5", "--max-size", "3000", "--oversized", "keep", "--volume", "dop26,prism"},
      {"--cluster", "0.4", "--min-extent", "0.5,0.1,1", "--max-extent", "20,5,9", "--volume", "prism"},
      {"--cluster", "0.4", "--range", "5:25", "--origin", "1,2,3", "--volume", "obb-pca"}};
  for (unsigned seed = 1; seed <= options.size(); ++seed) {
    SCOPED_TRACE(seed);
    const std::string name = std::to_string(seed);
    const Points points = yard(seed);
    const Json expected = found(objects(options[seed - 1], {}, binary("whole" + name + ".pcd", points)));
    ASSERT_GT(expected["clusters"].size(), 5U);
    for (const std::size_t count : {1UL, 7UL, 40UL}) {
      const std::string folder = tiles("tiles" + name + "_" + std::to_string(count), points, count);
      for (const char* const memory : {"1", "3", "600"}) {
        const Result result =
            objects(options[seed - 1], {"--together", "--check", "--memory", memory}, folder);
        Json report = found(result);
        for (Json& cluster : report["clusters"]) {
          for (Json& volume : cluster["volumes"]) {
            EXPECT_EQ(volume["outside"], 0);
            volume.erase("outside");
          }
        }
        EXPECT_TRUE(report == expected) << count << " tiles, " << memory << " MB";
      }
    }
  }
}

TEST_F(PcdBvTiledObjects, OfAnInputThatFailsAreLeftOut) {
  const Points points = yard(1);
  const std::string folder = tiles("tiles", points, 8);
  const Json expected = found(objects({"--cluster", "0.4"}, {"--together"}, folder));
  add_bad_tiles("tiles");
  const Result result = objects({"--cluster", "0.4"}, {"--together"}, folder);
  expect_bad_tiles_named(result, "tiles");
  Json report = result.json();
  EXPECT_EQ(report["parts"], 8);
  EXPECT_TRUE(report["clusters"] == expected["clusters"]);
  EXPECT_TRUE(report["counts"] == expected["counts"]);
}

TEST_F(PcdBvTiledObjects, GoToTextCsvAndMesh) {
  const std::string folder = tiles("tiles", yard(1), 3);
  const Result text =
      run({"--together", "--cluster", "0.4", "--mesh", at("m.vtp"), "--info", "--timings", folder});
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("together: 3 inputs, "));
  EXPECT_TRUE(std::filesystem::exists(at("m.vtp")));
  EXPECT_THAT(run({"--together", "--cluster", "0.4", "--format", "csv", folder}).out,
              HasSubstr("\ntogether,0,"));
  const std::string none = tiles("none", Points(100, {NAN, 0, 0}), 3);
  const Result nothing = objects({"--cluster", "0.4"}, {"--together"}, none);
  EXPECT_EQ(nothing.status, 0) << nothing.err;
  EXPECT_EQ(nothing.json()["counts"]["nonfinite"], 100);
}

TEST_F(PcdBvTiledObjects, RefuseWhatTheyDoNotHave) {
  const std::string folder = tiles("tiles", gaussian(100, 8), 2);
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--cluster", "1:0.1"},
                                             {"--cluster", "1", "--oversized", "split", "--max-size", "50"},
                                             {"--cluster", "1", "--ground", "plane"},
                                             {"--cluster", "1", "--labels", at("l.pcd")},
                                             {"--cluster", "1", "--image", at("i.png")},
                                             {"--cluster", "1", "--memory", "0"},
                                             {"--memory", "5"},
                                             {"--min-size", "5"}}) {
    const Result result = objects(options, {"--together"}, folder);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
  }
  EXPECT_EQ(run({"--memory", "5", "--cluster", "1", folder}).status, 2);
}

}  // namespace
}  // namespace pcl_bv::test
