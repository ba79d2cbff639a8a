// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Objects of maps in many files: --together --cluster with --ground slope and with classes.

#include <gmock/gmock.h>

#include <cstring>

#include "../io/las_bytes.h"
#include "tiles.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;

struct MapPoint {
  std::array<float, 3> at;
  std::int16_t value;
};
using Map = std::vector<MapPoint>;

class PcdBvTiledMaps : public Tiled {
 protected:
  // A hill of 80 m with houses, trees of 12 points each and reflections. The classes are 2 (ground), 6
  // (houses) and 3 to 5 (trees).
  static Map town(unsigned seed, std::size_t count) {
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random() % 65536) / 65536;
    };
    const auto ground = [](double x, double y) { return 2 * std::sin(x / 20) + 0.05 * y; };
    Map map;
    const auto add = [&](double x, double y, double above, int value) {
      map.push_back({{static_cast<float>(x), static_cast<float>(y), static_cast<float>(ground(x, y) + above)},
                     static_cast<std::int16_t>(value)});
    };
    for (int tree = 0; tree < 150; ++tree) {
      const double x = number(-40, 40), y = number(-40, 40);
      for (int i = 0; i < 12; ++i)
        add(x + number(-0.2, 0.2), y + number(-0.2, 0.2), number(1, 1.6), 3 + tree % 3);
    }
    while (map.size() < count) {
      const double x = number(-40, 40), y = number(-40, 40);
      const bool house =
          std::abs(std::fmod(x + 100, 20) - 10) < 4 && std::abs(std::fmod(y + 100, 25) - 10) < 5;
      add(x, y, house ? number(4, 5) : number(0, 0.05), house ? 6 : 2);
    }
    for (std::size_t i = 2000; i < map.size(); i += 9973)
      map[i].at[2] -= 30;
    for (std::size_t i = 70; i < map.size(); i += 400)
      map[i].at[i % 3] = std::numeric_limits<float>::quiet_NaN();
    if (seed % 2 == 0) std::shuffle(map.begin(), map.end(), random);
    return map;
  }

  std::string pcd(const std::string& name, const Map& map, bool as_text) const {
    std::string content = header(map.size(), as_text ? "ascii" : "binary");
    const auto replace = [&](const std::string& old, const std::string& by) {
      content.replace(content.find(old), old.size(), by);
    };
    replace("x y z", "class x y z");
    replace("4 4 4", "2 4 4 4");
    replace("F F F", "I F F F");
    replace("1 1 1", "1 1 1 1");
    for (const MapPoint& p : map) {
      char text[100];
      if (as_text) {
        std::snprintf(text, sizeof text, "%d %.9g %.9g %.9g\n", p.value, p.at[0], p.at[1], p.at[2]);
        content += text;
      } else {
        content.append(reinterpret_cast<const char*>(&p.value), 2);
        content.append(reinterpret_cast<const char*>(p.at.data()), 12);
      }
    }
    return file(name, content);
  }

  // Points without a finite coordinate are left out.
  std::string las(const std::string& name, const Map& map) const {
    Map finite;
    for (const MapPoint& p : map)
      if (std::isfinite(p.at[0] + p.at[1] + p.at[2])) finite.push_back(p);
    LasFile las;
    las.points = finite.size();
    std::string bytes = las.bytes();
    const std::size_t first = las.first_record();
    for (std::size_t i = 0; i < finite.size(); ++i) {
      const std::size_t at = first + i * las.record;
      for (std::size_t axis = 0; axis < 3; ++axis)
        LasFile::put(bytes, at + 4 * axis, static_cast<std::int32_t>(std::lround(1000 * finite[i].at[axis])));
      LasFile::put(bytes, at + 15, static_cast<std::uint8_t>(finite[i].value));
    }
    return file(name, bytes);
  }

  // Cuts the map into files; write(name, part, number) writes one. Returns the folder.
  template <typename Write>
  std::string folder(const std::string& name, const Map& map, std::size_t count, const Write& write) const {
    std::filesystem::create_directories(at(name));
    std::size_t begin = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t end =
          i + 1 == count ? map.size() : begin + (map.size() - begin) * 2 / (count - i + 1);
      const auto at = [&](std::size_t n) { return map.begin() + static_cast<std::ptrdiff_t>(n); };
      write(name + "/" + std::to_string(100 + i), Map(at(begin), at(end)), i);
      begin = end;
    }
    return at(name);
  }

  std::string pcd_tiles(const std::string& name, const Map& map, std::size_t count) const {
    return folder(name, map, count, [&](const std::string& tile, const Map& part, std::size_t i) {
      pcd(tile + ".pcd", part, i % 3 == 1);
    });
  }

  Result objects(std::vector<std::string> options, const std::vector<std::string>& more,
                 const std::string& input) const {
    options.insert(options.end(), {"--format", "jsonl"});
    options.insert(options.end(), more.begin(), more.end());
    options.push_back(input);
    return run(options);
  }

  std::string classes(const std::string& rows) const {
    return file("classes.yaml", "cluster: {tolerance: 0.5, class_field: class, classes: [" + rows + "]}");
  }
};

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
  refuses({"--ground", "slope", "--ground-cell", "0"}, "--ground-cell");
  refuses({"--ground", "slope", "--ground-cell", "x"}, "--ground-cell");
  refuses({"--ground", "zones", "--ground-cell", "1"}, "--ground-cell: only useful with --ground slope");
  refuses({"--ground", "slope", "--sensor-height", "1"}, "--sensor-height: only useful with --ground zones");
  refuses({"--ground", "slope", "--sensor", "1,2,3"}, "--sensor: only useful with --ground zones");
}

}  // namespace
}  // namespace pcl_bv::test
