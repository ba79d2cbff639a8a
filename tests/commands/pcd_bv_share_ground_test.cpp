// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Objects above the ground of maps in shares: --partial with --ground slope and --ground-parts.

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

#include "tiled_maps.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;

class PcdBvShareGround : public TiledMaps {
 protected:
  static std::vector<std::string> with(std::vector<std::string> options,
                                       const std::vector<std::string>& more) {
    options.insert(options.end(), more.begin(), more.end());
    return options;
  }

  // Writes the ground of shares, and then their objects.
  std::string shares_above_ground(const std::string& name, std::size_t ground_shares, std::size_t count,
                                  const std::vector<std::string>& ground,
                                  const std::vector<std::string>& clusters, const std::string& tiles) const {
    const std::string parts = shares(name + "_ground", ground_shares, ground, {tiles});
    return shares(name, count, with(with(ground, clusters), {"--ground-parts", parts}), {tiles});
  }

  // Changes a byte.
  static void damage(const std::string& path, std::streamoff at) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(at);
    const int byte = file.get();
    file.seekp(at);
    file.put(static_cast<char>(byte ^ 16));
  }
};

TEST_F(PcdBvShareGround, LeavesTheObjectsAndLabelsOfOneProcess) {
  const std::string own = classes(
      "{value: 2, drop: true}, {value: 3, tolerance: 0.2, min_size: 2, volumes: [sphere, dop14]}, "
      "{value: 6, tolerance: 1.5, max_size: 4000}");
  struct Case {
    std::vector<std::string> ground, reading, clusters;
  };
  const std::vector<Case> cases = {
      {{"--ground", "slope"}, {}, {"--cluster", "0.6", "--volume", "obb-yaw,prism"}},
      {{"--ground", "slope", "--ground-cell", "2", "--ground-slope", "30", "--ground-distance", "0.1", "--up",
        "0.01,0,1"},
       {"--range", "5:60"},
       {"--cluster", "0.6"}},
      {{"--ground", "slope"}, {"--origin", "1,2,3"}, {"--config", own, "--min-points", "3"}},
      {{"--ground", "slope"}, {"--range", "10:1000"}, {"--cluster", "0.5", "--class", "class"}}};
  for (unsigned seed = 1; seed <= cases.size(); ++seed) {
    SCOPED_TRACE(seed);
    const auto& [ground, reading, clusters] = cases[seed - 1];
    const std::string name = std::to_string(seed);
    const std::string tiles = pcd_tiles("tiles" + name, town(seed, 90'000), seed == 1 ? 2 : 7);
    const std::vector<std::string> merging = with(ground, clusters);
    const Result expected =
        objects(with(merging, reading), {"--together", "--labels", at("labels" + name)}, tiles);
    ASSERT_GT(expected.json()["clusters"].size(), 20U);
    ASSERT_GT(expected.json()["counts"]["ground"], 10'000);
    for (const std::size_t count : {1UL, 2UL, 5UL}) {
      const std::string parts = "parts" + name + "_" + std::to_string(count);
      const std::string folder =
          shares_above_ground(parts, 6 - count, count, with(ground, reading), clusters, tiles);
      const Result merged = objects(merging, {"--merge", "--labels", at(parts + "_labels")}, folder);
      EXPECT_EQ(merged.status, 0) << merged.err;
      EXPECT_TRUE(merged.out == expected.out) << count << " shares";
      expect_same_files(at(parts + "_labels"), at("labels" + name), seed == 1 ? 2 : 7);
    }
  }
}

TEST_F(PcdBvShareGround, HasTheSameBytesForAnyThreadsAndOrderOfPoints) {
  Map map = town(3, 200'000);
  const std::string tiles = pcd_tiles("tiles", map, 1);
  std::reverse(map.begin(), map.end());
  const std::string reversed = pcd_tiles("reversed", map, 1);
  const auto ground = [&](const std::string& name, const std::string& threads, const std::string& input) {
    const Result result = run({"--partial", at(name), "--ground", "slope", "--threads", threads, input});
    EXPECT_EQ(result.status, 0) << result.err;
    return read_file(at(name));
  };
  const std::string expected = ground("g", "1", tiles);
  EXPECT_GT(expected.size(), 6400 * 16U);
  EXPECT_TRUE(ground("g8", "8", tiles) == expected);
  EXPECT_TRUE(ground("again", "8", tiles) == expected);
  EXPECT_TRUE(ground("reversed_g", "1", reversed) == expected);
}

TEST_F(PcdBvShareGround, NamesAShareWithPointsThatItLacks) {
  Map map = town(5, 20'000);
  const std::string tiles = pcd_tiles("tiles", map, 3);
  const std::string ground = shares("ground", 2, {"--ground", "slope"}, {tiles});
  map.back().at[0] += 500;
  pcd_tiles("tiles", map, 3);
  const Result result =
      run({"--partial", at("p"), "--cluster", "0.5", "--ground", "slope", "--ground-parts", ground, tiles});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.error_lines(), 1U) << result.err;
  EXPECT_THAT(result.err, HasSubstr("/p: the inputs have changed since --ground-parts were made"));
  EXPECT_FALSE(std::filesystem::exists(at("p")));
}

TEST_F(PcdBvShareGround, IsWarnedOfIfAllPointsAreGround) {
  Map map;
  for (int i = 0; i < 4000; ++i)
    map.push_back({{static_cast<float>(i % 80), static_cast<float>(i / 80), 0}, 2});
  const std::string tiles = pcd_tiles("tiles", map, 2);
  const std::vector<std::string> clusters = {"--cluster", "0.5"}, ground = {"--ground", "slope"};
  const std::string parts = shares_above_ground("parts", 2, 2, ground, clusters, tiles);
  const Result merged = objects(with(clusters, ground), {"--merge"}, parts);
  const Result together = objects(with(clusters, ground), {"--together"}, tiles);
  EXPECT_THAT(merged.err, HasSubstr("together: all points were classified as ground (up is z): try --up"));
  EXPECT_EQ(merged.err, together.err);
  EXPECT_EQ(merged.status, 0);
}

TEST_F(PcdBvShareGround, NamesFilesOfTheGroundThatCannotBeUsed) {
  const Map map = town(5, 20'000);
  const std::vector<std::string> ground = {"--ground", "slope"};
  const std::string tiles = pcd_tiles("tiles", map, 3), other = pcd_tiles("other", town(6, 9'000), 2);
  const auto expect_error = [&](const std::string& parts, const std::string& what) {
    const Result result =
        run({"--partial", at("p"), "--cluster", "0.5", "--ground", "slope", "--ground-parts", parts, tiles});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
    EXPECT_THAT(result.err, HasSubstr(what));
    EXPECT_FALSE(std::filesystem::exists(at("p")));
  };
  const std::string missing = shares("missing", 2, ground, {tiles});
  std::filesystem::remove(missing + "/0");
  expect_error(missing, "--ground-parts: shares are missing: points 0 to ");
  std::filesystem::copy(missing + "/1", missing + "/2");
  expect_error(missing, "missing/2: overlaps another share");
  expect_error(shares("of_other", 1, ground, {other}), "of_other/0: is a share of another cloud");
  expect_error(shares("options", 1, {"--ground", "slope", "--ground-cell", "2"}, {tiles}),
               "options/0: was made with --ground slope --ground-cell 2");
  expect_error(at("nowhere"), "nowhere: no such file");
  std::filesystem::create_directories(at("empty"));
  expect_error(at("empty"), "empty: no file of partial results in this folder");
  expect_error(tiles + "/100.pcd", "100.pcd: is no file of the ground");
  const std::string bad = shares("bad", 1, ground, {tiles}) + "/0";
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(bad));
  for (const std::streamoff at : {std::streamoff{17}, std::streamoff{50}, size / 2, size - 2}) {
    damage(bad, at);
    expect_error(bad, "bad/0: ");
    damage(bad, at);
  }
  std::filesystem::resize_file(bad, static_cast<std::uintmax_t>(size - 10));
  expect_error(bad, "bad/0: ");
  const Result merged = run({"--merge", missing});
  EXPECT_EQ(merged.status, 1);
  EXPECT_THAT(merged.err, HasSubstr("missing/1: has the ground of a share: name it by --ground-parts"));
  const Result with_clusters = run({"--merge", "--cluster", "0.5", missing});
  EXPECT_EQ(with_clusters.status, 1);
  EXPECT_THAT(with_clusters.err,
              HasSubstr("missing/1: has the ground of a share: name it by --ground-parts"));
}

TEST_F(PcdBvShareGround, NamesSharesThatDoNotBelongTogether) {
  const std::string tiles = pcd_tiles("tiles", town(5, 20'000), 3);
  const std::vector<std::string> clusters = {"--cluster", "0.5"}, ground = {"--ground", "slope"};
  const std::string parts = shares_above_ground("parts", 2, 2, ground, clusters, tiles);
  const auto expect_error = [&](const std::vector<std::string>& options, const std::string& what) {
    const Result result = objects(options, {"--merge"}, parts);
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr(what));
  };
  expect_error(clusters,
               "parts/0: was made with --cluster 0.5 --min-points 1 --ground slope --ground-cell 1 ");
  expect_error({"--cluster", "0.5", "--ground", "slope", "--ground-distance", "0.3"},
               "give the same options");
  Map changed = town(5, 20'000);
  changed[0].at[2] -= 3;
  pcd_tiles("tiles", changed, 3);
  std::filesystem::rename(shares_above_ground("new", 2, 2, ground, clusters, tiles) + "/1", parts + "/1");
  expect_error(with(clusters, ground), "parts/1: was made with other --ground-parts than the files before");
}

TEST_F(PcdBvShareGround, ThatIsDamagedIsNamedWithTheInputsThatLackIt) {
  const std::string tiles = pcd_tiles("tiles", town(5, 20'000), 3);
  const std::vector<std::string> options = {"--cluster", "0.5", "--ground", "slope"};
  const std::string parts =
      shares_above_ground("parts", 1, 1, {"--ground", "slope"}, {"--cluster", "0.5"}, tiles);
  const std::string content = read_file(parts + "/0");
  damage(parts + "/0", static_cast<std::streamoff>(content.rfind("{\"scalar\"")) - 100);
  const Result merged = objects(options, {"--merge"}, parts);
  EXPECT_EQ(merged.status, 0) << merged.err;
  EXPECT_TRUE(merged.out == objects(options, {"--together"}, tiles).out);
  const Result labelled = objects(options, {"--merge", "--labels", at("labels")}, parts);
  EXPECT_EQ(labelled.status, 1);
  EXPECT_EQ(labelled.error_lines(), 3U);
  EXPECT_THAT(labelled.err, HasSubstr("100.pcd: " + parts + "/0: is damaged: its ground has changed"));
  EXPECT_TRUE(labelled.out == merged.out);
}

TEST_F(PcdBvShareGround, IsAskedForOnlyWhereItIsNeeded) {
  const std::string input = binary("a.pcd", gaussian(100, 1));
  const auto refuses = [&](const std::vector<std::string>& options, const std::string& why) {
    std::vector<std::string> all = options;
    all.push_back(input);
    const Result result = run(all);
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr(why));
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
  };
  const std::string p = at("p"), g = at("g");
  std::ofstream(g) << "text";
  refuses({"--partial", p, "--cluster", "1", "--ground", "slope"}, "--ground slope needs --ground-parts");
  refuses({"--partial", p, "--cluster", "1", "--ground-parts", g}, "--ground-parts: only useful with");
  refuses({"--partial", p, "--ground", "slope", "--ground-parts", g}, "--ground-parts: only useful with");
  refuses({"--partial", p, "--ground", "slope", "--volume", "aabb"},
          "--partial --ground slope: cannot be combined with --volume");
  refuses({"--partial", p, "--ground", "zones"}, "--partial: cannot be combined with --ground");
  refuses({"--merge", "--ground", "slope"}, "--merge: cannot be combined with --ground");
  const Result overwritten =
      run({"--partial", g, "--cluster", "1", "--ground", "slope", "--ground-parts", g, input});
  EXPECT_EQ(overwritten.status, 2);
  EXPECT_THAT(overwritten.err, HasSubstr("is an input and would be overwritten"));
  EXPECT_FALSE(std::filesystem::exists(p));
}

}  // namespace
}  // namespace pcl_bv::test
