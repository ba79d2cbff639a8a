// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Objects of maps in many files: --together --cluster with --ground slope and with classes.

#include <gmock/gmock.h>

#include "tiled_maps.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;

class PcdBvTiledMaps : public TiledMaps {};

TEST_F(PcdBvTiledMaps, AreThoseOfOneFileWithGroundClassesAndBoth) {
  const std::string rows =
      "{value: 2, drop: true}, {value: 3, tolerance: 0.2, min_size: 2, volumes: [sphere, dop14]}, "
      "{value: 6, tolerance: 1.5, max_size: 4000}, {value: 77, drop: true}";
  const std::string own = classes(rows);
  const std::vector<std::vector<std::string>> options = {
      {"--cluster", "0.6", "--ground", "slope", "--volume", "obb-yaw,prism"},
      {"--cluster", "0.6", "--ground", "slope", "--range", "5:60", "--ground-cell", "2", "--ground-slope",
       "30", "--ground-distance", "0.1", "--up", "0.01,0,1"},
      {"--cluster", "0.6", "--class", "class", "--volume", "aabb,sphere"},
      {"--config", own, "--volume", "aabb,obb-lshape", "--max-extent", "30,30,3"},
      {"--config", own, "--ground", "slope", "--origin", "1,2,3", "--min-points", "3", "--volume", "dop26"},
      {"--cluster", "0.5", "--class", "class", "--ground", "slope", "--range", "10:1000"}};
  for (unsigned seed = 1; seed <= options.size(); ++seed) {
    SCOPED_TRACE(seed);
    const std::string name = std::to_string(seed);
    const Map map = town(seed, 90'000);
    const Json expected = found(objects(options[seed - 1], {}, pcd("whole" + name + ".pcd", map, false)));
    ASSERT_GT(expected["clusters"].size(), 20U);
    for (const std::size_t count : {1UL, 2UL, 13UL}) {
      const std::string tiles = pcd_tiles("tiles" + name + "_" + std::to_string(count), map, count);
      for (const char* const memory : {"2", "600"}) {
        Json report = found(objects(options[seed - 1], {"--together", "--memory", memory}, tiles));
        EXPECT_EQ(report["counts"], expected["counts"]) << count << " tiles";
        EXPECT_TRUE(report == expected) << count << " tiles, " << memory << " MB";
      }
    }
  }
}

TEST_F(PcdBvTiledMaps, OfSharesWithClassesAreThoseOfOneProcess) {
  const std::string own = classes(
      "{value: 2, drop: true}, {value: 3, tolerance: 0.2, min_size: 2, volumes: [sphere, dop14]}, "
      "{value: 6, tolerance: 1.5, max_size: 4000}");
  const std::vector<std::vector<std::string>> options = {
      {"--cluster", "0.6", "--class", "class", "--volume", "aabb,sphere"},
      {"--config", own, "--volume", "aabb,obb-lshape", "--max-extent", "30,30,3", "--min-points", "3"}};
  for (unsigned seed = 1; seed <= options.size(); ++seed) {
    SCOPED_TRACE(seed);
    const std::string name = std::to_string(seed);
    Map map = town(seed, 60'000);
    map.erase(
        std::remove_if(map.begin(), map.begin() + 20'000, [](const MapPoint& p) { return p.value == 4; }),
        map.begin() + 20'000);  // the first share has no point of a class
    const std::string tiles = pcd_tiles("tiles" + name, map, 5);
    const Result expected = objects(options[seed - 1], {"--together"}, tiles);
    ASSERT_GT(expected.json()["clusters"].size(), 20U);
    for (const std::size_t count : {1UL, 4UL}) {
      const std::string parts = at("parts" + name + std::to_string(count));
      for (std::size_t k = 0; k < count; ++k) {
        std::vector<std::string> share = {"--partial", parts + "/" + std::to_string(k), "--part",
                                          std::to_string(k) + "/" + std::to_string(count), tiles};
        share.insert(share.end(), options[seed - 1].begin(), options[seed - 1].end());
        const Result made = run(share);
        ASSERT_EQ(made.status, 0) << made.err;
      }
      for (const std::vector<std::string>& more :
           std::vector<std::vector<std::string>>{{}, {"--check"}, {"--labels"}}) {
        std::vector<std::string> merge = {"--merge"}, together = {"--together"};
        merge.insert(merge.end(), more.begin(), more.end());
        together.insert(together.end(), more.begin(), more.end());
        if (merge.back() == "--labels") {
          merge.push_back(parts + "_labels");
          together.push_back(parts + "_expected");
        }
        const Result merged = objects(options[seed - 1], merge, parts);
        EXPECT_EQ(merged.status, 0) << merged.err;
        EXPECT_TRUE(merged.out == objects(options[seed - 1], together, tiles).out) << count << " shares";
      }
      expect_same_files(parts + "_labels", parts + "_expected", 5);
      const Result other = objects({"--cluster", "0.6"}, {"--merge"}, parts);
      EXPECT_EQ(other.status, 1);
      EXPECT_THAT(other.err, HasSubstr(" --class class"));
    }
  }
}

TEST_F(PcdBvTiledMaps, CountWhatGroundAndClassesDrop) {
  const Map map = town(4, 40'000);
  const std::string tiles = pcd_tiles("tiles", map, 3);
  const Json ground = found(objects({"--cluster", "0.5", "--ground", "slope"}, {"--together"}, tiles));
  EXPECT_GT(ground["counts"]["ground"], 20'000);
  EXPECT_EQ(ground["counts"]["nonfinite"], 100);
  EXPECT_FALSE(ground["clusters"][0].contains("class"));
  const Json dropped = found(objects({"--config", classes("{value: 2, drop: true}")}, {"--together"}, tiles));
  EXPECT_GT(dropped["counts"]["class"], 20'000);
  EXPECT_EQ(dropped["counts"]["ground"], 0);
  EXPECT_EQ(dropped["clusters"][0]["class"], 6);
}

TEST_F(PcdBvTiledMaps, AreThoseOfOneFileOfLas) {
  const Map map = town(3, 50'000);
  const std::string whole = las("whole.las", map);
  const std::string tiles =
      folder("tiles", map, 6,
             [&](const std::string& tile, const Map& part, std::size_t) { las(tile + ".las", part); });
  const std::string config =
      file("las.yaml",
           "ground: {method: slope}\ncluster: {tolerance: 0.5, class_field: "
           "classification, classes: [{value: 2, drop: true}, {value: 6, min_size: 50}]}");
  const Json expected = found(objects({"--config", config}, {}, whole));
  EXPECT_GT(expected["clusters"].size(), 100U);
  EXPECT_TRUE(found(objects({"--config", config}, {"--together"}, tiles)) == expected);
  EXPECT_GT(expected["counts"]["ground"], 20'000);
}

TEST_F(PcdBvTiledMaps, LeaveOutTilesWithoutTheField) {
  const Map map = town(2, 40'000);
  const std::string tiles = pcd_tiles("tiles", map, 3);
  const Json expected = found(objects({"--cluster", "0.5", "--class", "class"}, {"--together"}, tiles));
  binary("tiles/0.pcd", gaussian(100, 1));
  binary("tiles/zz.pcd", gaussian(50'000, 1));
  pcd("tiles/empty.pcd", {}, false);
  const Result result = objects({"--cluster", "0.5", "--class", "class"}, {"--together"}, tiles);
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("tiles/0.pcd: there is no field 'class'; the fields are x, y, z"));
  EXPECT_THAT(result.err, HasSubstr("tiles/zz.pcd: there is no field 'class'; the fields are x, y, z"));
  EXPECT_EQ(result.error_lines(), 2U) << result.err;
  EXPECT_EQ(result.json()["parts"], 4);
  EXPECT_EQ(result.json()["clusters"], expected["clusters"]);
  const Result all = objects({"--cluster", "0.5", "--class", "x"}, {"--together"}, tiles);
  EXPECT_EQ(all.status, 1);
  EXPECT_THAT(all.err, HasSubstr("field 'x' is floating point, not an integer"));
}

TEST_F(PcdBvTiledMaps, HaveManyClasses) {
  Map map = town(1, 20'000);
  for (std::size_t i = 0; i < map.size(); ++i)
    map[i].value = static_cast<std::int16_t>(static_cast<int>(i * 7919 % 300) - 150);
  const std::vector<std::string> options{"--cluster", "3", "--min-size", "3", "--class", "class"};
  const Json expected = found(objects(options, {}, pcd("whole.pcd", map, false)));
  EXPECT_GT(expected["clusters"].size(), 200U);
  EXPECT_TRUE(found(objects(options, {"--together"}, pcd_tiles("tiles", map, 4))) == expected);
}

TEST_F(PcdBvTiledMaps, HaveNothingAboveGroundAndNothingAtAll) {
  const std::string ground = binary("ground.pcd", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const std::vector<std::string> options{"--cluster", "1", "--ground", "slope"};
  const Result flat = objects(options, {"--together"}, ground);
  EXPECT_EQ(flat.json()["counts"]["ground"], 3);
  EXPECT_EQ(found(flat), found(objects(options, {}, ground)));
  const std::string none = binary("none.pcd", Points(5, {NAN, 0, 0}));
  EXPECT_EQ(found(objects(options, {"--together"}, none)), found(objects(options, {}, none)));
  std::vector<std::string> classed{"--cluster", "1", "--class", "class"};
  EXPECT_EQ(found(objects(classed, {"--together"}, pcd("no.pcd", {}, false)))["points"], 0);
}

TEST_F(PcdBvTiledMaps, RefuseOtherGroundAndBadSettings) {
  const std::string input = binary("a.pcd", gaussian(100, 1));
  const auto refuses = [&](const std::vector<std::string>& options, const std::string& why) {
    const Result result = objects(options, {}, input);
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr(why));
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
  };
  for (const char* const method : {"plane", "zones"})
    refuses({"--together", "--cluster", "1", "--ground", method}, "only with --ground slope");
  refuses({"--together", "--ground", "slope"}, "--together: cannot be combined with --ground");
  refuses({"--together", "--cluster", "1", "--ground", "slope", "--ground-parts", "p"},
          "--ground-parts: only useful with --partial, --cluster and --ground slope");
  refuses({"--ground", "slope", "--ground-cell", "0"}, "--ground-cell");
  refuses({"--ground", "slope", "--ground-cell", "x"}, "--ground-cell");
  refuses({"--ground", "zones", "--ground-cell", "1"}, "--ground-cell: only useful with --ground slope");
  refuses({"--ground", "slope", "--sensor-height", "1"}, "--sensor-height: only useful with --ground zones");
  refuses({"--ground", "slope", "--sensor", "1,2,3"}, "--sensor: only useful with --ground zones");
}

}  // namespace
}  // namespace pcl_bv::test
