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
  std::vector<std::vector<std::string>> options = cluster_options();
  options.push_back({"--cluster", "0.4", "--range", "5:25", "--origin", "1,2,3", "--volume", "obb-pca"});
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
  expect_bad_tiles_listed(report, "tiles");
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

TEST_F(PcdBvTiledObjects, LabelThePointsOfEachTileAsInOneFile) {
  const Points points = yard(1);
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {"--cluster", "0.4", "--min-points", "3", "--max-extent", "20,5,9"},
           {"--cluster", "0.4", "--ground", "slope", "--range", "3:25"}}) {
    const Result whole = objects(options, {"--labels", at("whole_labels.pcd")}, binary("whole.pcd", points));
    ASSERT_EQ(whole.status, 0) << whole.err;
    const std::vector<std::uint32_t> expected = labels_in(at("whole_labels.pcd"));
    const std::string folder = tiles("tiles", points, 7);
    const Result result = objects(options, {"--together", "--memory", "1", "--labels", at("labels")}, folder);
    EXPECT_EQ(result.status, 0) << result.err;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(at("labels")))
      files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<std::uint32_t> found;
    for (const auto& file : files) {
      const std::vector<std::uint32_t> part = labels_in(file.string());
      found.insert(found.end(), part.begin(), part.end());
    }
    EXPECT_EQ(found, expected);
    std::filesystem::remove_all(at("labels"));
  }
}

TEST_F(PcdBvTiledObjects, RefuseWhatTheyDoNotHave) {
  const std::string folder = tiles("tiles", gaussian(100, 8), 2);
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--cluster", "1:0.1"},
                                             {"--cluster", "1", "--oversized", "split", "--max-size", "50"},
                                             {"--cluster", "1", "--ground", "plane"},
                                             {"--cluster", "1", "--labels", at("l.pcd")},
                                             {"--labels", at("labels")},
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
