// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The points of each object in a file of its own: --objects.

#include <gmock/gmock.h>

#include <cstring>
#include <iterator>
#include <map>

#include "pcl_bv/io/read_cloud.h"
#include "tiles.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

class PcdBvObjectFiles : public Tiled {
 protected:
  // Clumps 3 m apart, with their points shuffled, and single points between them.
  static Points clumps(unsigned seed) {
    std::mt19937 random(seed);
    const auto even = [&] { return static_cast<float>(random() % 65536) / 65536.0F; };
    Points points;
    for (int clump = 0; clump < 30; ++clump) {
      const auto x = static_cast<float>(3 * (clump % 6)), y = static_cast<float>(3 * (clump / 6));
      for (int i = 0; i < 20 + 100 * (clump % 7); ++i)
        points.push_back({x + even(), y + even(), even()});
      points.push_back({x + 2, y + 2, even()});
      points.push_back({x, NAN, 0});
    }
    std::shuffle(points.begin(), points.end(), random);
    return points;
  }

  static Points read(const std::string& path) {
    const RawCloud cloud = read_pcd(path);
    EXPECT_EQ(cloud.point_step, 12U);
    Points points(cloud.size());
    std::memcpy(points.data(), cloud.data.data(), cloud.data.size());
    return points;
  }

  static std::size_t files_in(const std::string& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }

  // Expects one file for each reported object, with its points in the order of the cloud, bit for bit.
  void expect_objects(const Json& report, const Points& cloud, const std::string& folder) const {
    ASSERT_EQ(files_in(folder), report["clusters"].size());
    std::size_t total = 0;
    for (const Json& cluster : report["clusters"]) {
      const Points object = read(folder + '/' + std::to_string(cluster["id"].get<int>()) + ".pcd");
      ASSERT_EQ(object.size(), cluster["points"]);
      total += object.size();
      std::size_t next = 0;
      for (const auto& point : cloud)
        next += next < object.size() && std::memcmp(&point, &object[next], sizeof point) == 0;
      EXPECT_EQ(next, object.size()) << "not a subsequence of the cloud";
      const Json& box = cluster["volumes"][0];
      for (const auto& point : object)
        for (std::size_t axis = 0; axis < 3; ++axis)
          ASSERT_TRUE(point[axis] >= box["min"][axis] && point[axis] <= box["max"][axis]);
    }
    std::size_t dropped = 0;
    for (const auto& [reason, count] : report["counts"].items())
      dropped += count.get<std::size_t>();
    EXPECT_EQ(total + dropped, cloud.size());
  }

  Json report_of(const std::vector<std::string>& arguments) const {
    std::vector<std::string> all{"--cluster", "0.5",  "--min-size", "30",
                                 "--volume",  "aabb", "--format",   "jsonl"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Result result = run(all);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.problems(), "");
    return Json::parse(result.out.substr(0, result.out.find('\n')));
  }
};

TEST_F(PcdBvObjectFiles, HaveThePointsOfTheirClustersInTheOrderOfTheCloud) {
  const Points points = clumps(1);
  expect_objects(report_of({"--objects", at("one"), binary("a.pcd", points)}), points, at("one"));
}

TEST_F(PcdBvObjectFiles, OfATiledCloudAreThoseOfTheWholeCloud) {
  const Points points = clumps(2);
  report_of({"--objects", at("whole"), binary("a.pcd", points)});
  const std::string folder = tiles("tiles", points, 7);
  for (const char* const memory : {"1", "600"}) {
    const std::string out = at(std::string("out") + memory);
    expect_objects(report_of({"--together", "--memory", memory, "--objects", out, folder}), points, out);
    for (const fs::directory_entry& file : fs::directory_iterator(out))
      EXPECT_EQ(read_file(file.path()), read_file(at("whole") / file.path().filename()));
  }
}

TEST_F(PcdBvObjectFiles, OfSharesAreThoseOfTheWholeCloud) {
  const Points points = clumps(2);
  const std::string folder = tiles("tiles", points, 7);
  for (const char* const part : {"0/3", "1/3", "2/3"})
    ASSERT_EQ(run({"--cluster", "0.5", "--volume", "aabb", "--partial", at("parts/") + part[0], "--part",
                   part, folder})
                  .status,
              0);
  expect_objects(report_of({"--merge", "--objects", at("out"), at("parts")}), points, at("out"));
}

TEST_F(PcdBvObjectFiles, OfSeveralInputsAreInAFolderForEach) {
  const Points first = clumps(3), second = clumps(4);
  const std::string a = binary("a.pcd", first), b = binary("b.pcd", second);
  const Json report = report_of({"--objects", at("out"), a, b});
  expect_objects(report, first, at("out/a"));
  EXPECT_EQ(files_in(at("out")), 2U);
  EXPECT_GT(files_in(at("out/b")), 5U);
}

TEST_F(PcdBvObjectFiles, HaveTheCoordinatesOfTheVolumes) {
  report_of({"--origin", "1,2,3", "--objects", at("out"), binary("a.pcd", clumps(5))});
  const RawCloud cloud = read_pcd(at("out/0.pcd"));
  EXPECT_EQ(cloud.point_step, 24U);  // differences are doubles
}

TEST_F(PcdBvObjectFiles, ReplaceOlderOnesAndLeaveNoOtherFiles) {
  const Points points = clumps(6);
  fs::create_directories(at("out"));
  file("out/0.pcd", "old");
  expect_objects(report_of({"--objects", at("out"), binary("a.pcd", points)}), points, at("out"));
}

TEST_F(PcdBvObjectFiles, ThatCannotBeWrittenAreOneLineAndStatusOne) {
  const Points points = clumps(7);
  const std::string cloud = binary("a.pcd", points), tiled = tiles("tiles", points, 3);
  file("file", "no folder");
  fs::create_directories(at("taken/0.pcd"));
  for (const std::string& folder : {at("file"), at("file/below"), at("taken")}) {
    for (const bool together : {false, true}) {
      std::vector<std::string> arguments{"--cluster", "0.5", "--objects", folder, together ? tiled : cloud};
      if (together) arguments.insert(arguments.begin(), "--together");
      const Result result = run(arguments);
      EXPECT_EQ(result.status, 1);
      EXPECT_EQ(result.error_lines(), 1U) << result.err;
      EXPECT_THAT(result.err, StartsWith("pcd_bv: " + folder));
      EXPECT_THAT(result.out, HasSubstr("obb-lshape"));  // the report is still written
    }
  }
}

TEST_F(PcdBvObjectFiles, AreRejectedWhereThereAreNoObjectsOrInputsWouldBeLost) {
  fs::create_directories(at("in"));
  const std::string cloud = binary("in/0.pcd", clumps(8));
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"--objects", at("out"), cloud},
           {"--together", "--objects", at("out"), cloud},
           {"--partial", at("p"), "--objects", at("out"), cloud},
           {"--merge", "--objects", at("out"), at("p")},
           {"--cluster", "1", "--objects", at("in"), cloud},
           {"--together", "--cluster", "1", "--objects", at("in"), at("in")}}) {
    const Result result = run(arguments);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
    EXPECT_FALSE(fs::exists(at("out")));
  }
}

TEST_F(PcdBvObjectFiles, OfATownAreItsObjects) {
  ASSERT_EQ(run({"town-objects:4", at("town")}, {.program = "synth"}).status, 0);
  ASSERT_EQ(run({"--together", "--cluster", "0.5", "--objects", at("out"), at("town")}).status, 0);
  // The objects inside the town, by the bits of a point. Those that its border cuts can be several clusters.
  std::map<std::array<float, 3>, std::uint32_t> object_of;
  std::map<std::uint32_t, std::size_t> sizes;
  for (const fs::directory_entry& tile : fs::directory_iterator(at("town"))) {
    const RawCloud cloud = read_pcd(tile.path());
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      std::array<float, 3> xyz{};
      std::uint32_t object = 0;
      std::memcpy(xyz.data(), cloud.data.data() + 16 * i, 12);
      std::memcpy(&object, cloud.data.data() + 16 * i + 12, 4);
      object_of[xyz] = object;
      ++sizes[object];
    }
  }
  std::size_t inside = 0;
  for (std::size_t id = 0; id < files_in(at("out")); ++id) {
    const Points points = read(at("out/" + std::to_string(id) + ".pcd"));
    bool at_border = false;
    for (const auto& p : points) {
      ASSERT_EQ(object_of.at(p), object_of.at(points[0])) << id;
      at_border = at_border || std::min(p[0], p[1]) < 1 || std::max(p[0], p[1]) > 199;
    }
    if (at_border) continue;
    ++inside;
    EXPECT_EQ(points.size(), sizes[object_of.at(points[0])]) << id;
  }
  EXPECT_GT(inside, 200U);
}

}  // namespace
}  // namespace pcl_bv::test
