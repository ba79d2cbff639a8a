// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/tileset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <random>

#include "geographic_region.h"
#include "tile_files.h"

namespace pcl_bv::detail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST_F(Tilesets, HaveNewVolumesOfTheirOldKindsAndNoOtherChange) {
  write_text(file("a.pnts"), cloud(kPoints));
  EXPECT_EQ(update(leaf("a.pnts")).updated, 1U);
  const std::string box = R"({"box":[2,4,8,1,0,0,0,2,0,0,0,5]})";
  EXPECT_EQ(read_text(file("tileset.json")), tileset(leaf("a.pnts", box)));
  EXPECT_EQ(update(leaf("./a.pnts?v=2", R"({"sphere":[9,9,9,1]})")).updated, 1U);
  EXPECT_THAT(sphere(), ElementsAre(2, 4, 8, testing::DoubleNear(std::sqrt(30), 1e-12)));
}

TEST_F(Tilesets, EncloseTheContentsOfDescendantsInTheFrameOfEachTile) {
  write_text(file("a.pnts"), cloud(kPoints, R"(,"RTC_CENTER":[1000000,0,0])"));
  write_text(file("b.pnts"), cloud({0, 0, 0}));
  const std::string moved = R"(,"transform":[0,1,0,0,-1,0,0,0,0,0,1,0,10,0,0,1])";  // turned left, then moved
  const TilesetUpdate done = update(R"({"boundingVolume":)" + kUnit + R"(,"geometricError":9,"children":[)" +
                                    leaf("a.pnts", kUnit, moved) + "," + leaf("b.pnts") + "]}");
  EXPECT_EQ(done.tiles, 3U);
  EXPECT_EQ(done.updated, 3U);
  EXPECT_EQ(root()["children"][0]["boundingVolume"],
            Json::parse(R"({"box":[1000002,4,8,1,0,0,0,2,0,0,0,5]})"));
  EXPECT_EQ(root()["children"][1]["boundingVolume"], Json::parse(R"({"box":[0,0,0,0,0,0,0,0,0,0,0,0]})"));
  const Json box = volume()["box"];
  const auto number = [&](std::size_t i) { return box[i].get<double>(); };
  const auto inside = [&](const Eigen::Vector3d& p) {
    Eigen::Vector3d from_center = p - Eigen::Vector3d(number(0), number(1), number(2));
    for (std::size_t i = 3; i < 12; i += 3) {
      const Eigen::Vector3d half(number(i), number(i + 1), number(i + 2));
      if (std::abs(from_center.dot(half)) > half.squaredNorm() * (1 + 1e-9)) return false;
    }
    return true;
  };
  EXPECT_TRUE(inside({0, 0, 0}));
  for (std::size_t i = 0; i < kPoints.size(); i += 3)
    EXPECT_TRUE(inside({10 - kPoints[i + 1], 1e6 + kPoints[i], kPoints[i + 2]}));
}

TEST_F(Tilesets, ReadGltfWithYUpAndQuantizedPoints) {
  write_text(file("a b.glb"), triangle(R"(,"translation":[10,20,30],"scale":[2,2,2])"));
  update(leaf("a%20b.glb"));
  // x, y, z of glTF are x, z, -y of the tile.
  EXPECT_EQ(volume(), Json::parse(R"({"box":[11,-33,22,1,0,0,0,3,0,0,0,2]})"));
  const std::string inner = triangle(R"(,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1])");
  const std::string table = R"({"RTC_CENTER":[100,0,0],"BATCH_LENGTH":0})";
  write_text(file("c.b3dm"), "b3dm" + word(1) + word(28 + table.size() + inner.size()) + word(table.size()) +
                                 word(0) + word(0) + word(0) + table + inner);
  update(leaf("c.b3dm"));
  EXPECT_EQ(volume(), Json::parse(R"({"box":[105.5,-1.5,1,0.5,0,0,0,1.5,0,0,0,1]})"));
  write_text(file("q.pnts"), pnts(R"({"POINTS_LENGTH":2,"POSITION_QUANTIZED":{"byteOffset":0},)"
                                  R"("QUANTIZED_VOLUME_OFFSET":[10,0,0],"QUANTIZED_VOLUME_SCALE":[2,4,8]})",
                                  bytes_of(std::vector<std::uint16_t>{0, 0, 0, 65535, 65535, 65535})));
  update(leaf("q.pnts", R"({"sphere":[0,0,0,1]})"));
  EXPECT_THAT(sphere(), ElementsAre(11, 2, 4, testing::DoubleNear(std::sqrt(21), 1e-12)));
}

TEST_F(Tilesets, HaveRegionsOfTheirPointsOnTheEllipsoid) {
  // The corner of 0, 0 and height 100, and a point on the axis of the Earth, 7 m above the pole.
  EXPECT_LT((to_geographic({6378237, 0, 0}) - Eigen::Vector3d(0, 0, 100)).norm(), 1e-8);
  EXPECT_LT((to_geographic({0, 0, 6356752.314245179 + 7}) - Eigen::Vector3d(0, M_PI / 2, 7)).norm(), 1e-8);
  for (const double latitude : {-1.2, 0.3, 1.5}) {
    const double e2 = (2 - 1 / 298.257223563) / 298.257223563, sine = std::sin(latitude);
    const double n = 6378137 / std::sqrt(1 - e2 * sine * sine), height = 4321, longitude = 2.5;
    const Eigen::Vector3d p((n + height) * std::cos(latitude) * std::cos(longitude),
                            (n + height) * std::cos(latitude) * std::sin(longitude),
                            (n * (1 - e2) + height) * sine);
    EXPECT_LT((to_geographic(p) - Eigen::Vector3d(longitude, latitude, height)).head<2>().norm(), 1e-14);
    EXPECT_NEAR(to_geographic(p).z(), height, 1e-8);
  }
  write_text(file("a.pnts"), cloud({0, 0, 0, 50, 0, 0}));
  write_text(file("b.pnts"), cloud({0, 1000, 0}));
  const std::string region = R"({"region":[0,0,0,0,0,0]})";
  const std::string earth = R"(,"transform":[1,0,0,0,0,1,0,0,0,0,1,0,6378137,0,0,1])";
  EXPECT_EQ(update(leaf("a.pnts", region, earth + R"(,"children":[)" + leaf("b.pnts", region) + "]")).updated,
            2U);
  const auto found = volume()["region"].get<std::vector<double>>();
  const std::vector<double> expected{0, 0, 1000 / 6378137.0, 0, 0, 50};
  ASSERT_EQ(found.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(found[i], expected[i], i < 4 ? 1e-10 : i == 4 ? 1e-6 : 0.1) << i;
  EXPECT_THAT(update(leaf("a.pnts", region)).problems, ElementsAre(HasSubstr("EPSG 4978")));
}

TEST_F(Tilesets, KeepVolumesOfContentsThatCannotBeRead) {
  write_text(file("b.pnts"), cloud({0, 0, 0, 9, 9, 9}));
  const std::string parent = R"({"boundingVolume":)" + kUnit + R"(,"children":[)";
  const TilesetUpdate done = update(parent + leaf("missing.pnts", R"({"box":[50,0,0,1,0,0,0,1,0,0,0,1]})") +
                                    "," + leaf("b.pnts") + "," + leaf("inner.json") + "]}");
  EXPECT_EQ(done.updated, 2U);
  EXPECT_THAT(done.problems, ElementsAre("missing.pnts: no such file or directory"));
  EXPECT_EQ(root()["children"][0]["boundingVolume"]["box"][0], 50);
  EXPECT_GE(volume()["box"][0].get<double>(), 25);  // encloses the old volume of the missing tile
  EXPECT_EQ(update(R"({"boundingVolume":)" + kUnit + "}").updated, 0U);
  EXPECT_THAT(update(leaf("b.pnts", R"({"extensions":{}})")).problems,
              ElementsAre(HasSubstr("is no box, sphere")));
  EXPECT_THAT(update(leaf("http://a/b.pnts")).problems, ElementsAre(HasSubstr("is no file")));
}

TEST_F(Tilesets, NameWhatIsWrongWithContents) {
  EXPECT_THAT(problem("hello"), HasSubstr("bad: is no .pnts, .glb or .b3dm file"));
  EXPECT_THAT(problem("pnts"), HasSubstr("is cut"));
  const std::string good = cloud(kPoints);
  for (std::size_t size = 4; size < good.size(); ++size)
    EXPECT_NE(problem(good.substr(0, size)), "no problem") << size;
  EXPECT_THAT(problem(pnts(R"({"POINTS_LENGTH":1e9,"POSITION":{"byteOffset":0}})", "")),
              HasSubstr("POINTS_LENGTH"));
  EXPECT_THAT(problem(pnts(R"({"POINTS_LENGTH":2,"POSITION":{"byteOffset":-1}})", "")),
              HasSubstr("byteOffset"));
  EXPECT_THAT(problem(pnts(R"({"POINTS_LENGTH":2})", "")), HasSubstr("has no \"POSITION_QUANTIZED\""));
  EXPECT_THAT(problem(cloud({NAN, 0, 0})), HasSubstr("no valid point"));
  EXPECT_THAT(problem(triangle("", R"(,"byteOffset":4)")), HasSubstr("is cut"));
  EXPECT_THAT(problem(triangle("", R"(,"sparse":{})")), HasSubstr("sparse"));
  EXPECT_THAT(problem(triangle(R"(,"skin":0)")), HasSubstr("skin"));
  EXPECT_THAT(problem(triangle(R"(,"children":[0])")), HasSubstr("a node has two parents"));
  EXPECT_THAT(problem(triangle("", "", R"(,"extensionsUsed":["KHR_draco_mesh_compression"])")),
              HasSubstr("KHR_draco_mesh_compression"));
}

TEST_F(Tilesets, AreRefusedAndUnchangedIfTheyAreNone) {
  const auto error = [&](const std::string& text) {
    write_text(file("tileset.json"), text);
    try {
      update_tileset(file("tileset.json"), {find_method("aabb")}, {});
    } catch (const IoError& wrong) {
      EXPECT_EQ(read_text(file("tileset.json")), text);
      return std::string(wrong.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(error("[]"), HasSubstr("no \"root\""));
  EXPECT_THAT(error("{}"), HasSubstr("no \"root\""));
  EXPECT_THAT(error("3"), HasSubstr("no \"root\""));
  EXPECT_THAT(error("{\"root\":"), HasSubstr("JSON"));
  EXPECT_THAT(error(tileset("{}")), HasSubstr("no \"boundingVolume\""));
  EXPECT_THAT(error(tileset(R"({"boundingVolume":{"box":[1]}})")), HasSubstr("12 numbers"));
  EXPECT_THAT(error(tileset(R"({"boundingVolume":{},"transform":[1]})")), HasSubstr("16 numbers"));
  EXPECT_THAT(error(tileset(R"({"boundingVolume":{},"children":[3]})")), HasSubstr("a tile is no object"));
  EXPECT_THAT(error(tileset(R"({"boundingVolume":{},"content":{}})")), HasSubstr("uri"));
}

TEST_F(Tilesets, OfClustersHaveABoxOrSphereForEach) {
  Report report;
  report.clusters.resize(3);
  report.clusters[0].volumes = {{"dop6", Kdop(), {}}, {"sphere-exact", Sphere({1, 2, 3}, 4), {}}};
  report.clusters[1].volumes = {{"hull", Hull(), {}}};
  report.clusters[2].volumes = {{"aabb", Aabb({0, 0, 0}, {2, 4, 16}), {}}};
  std::string text;
  write_tileset(report, vector_source(report.clusters), TileFrame::cartesian,
                [&](std::string& piece) { text += piece; });
  const Json json = Json::parse(text);
  EXPECT_EQ(json["asset"]["version"], "1.1");
  ASSERT_EQ(json["root"]["children"].size(), 2U);
  EXPECT_EQ(json["root"]["children"][0]["boundingVolume"], Json::parse(R"({"sphere":[1,2,3,4]})"));
  EXPECT_EQ(json["root"]["children"][1]["boundingVolume"],
            Json::parse(R"({"box":[1,2,8,1,0,0,0,2,0,0,0,8]})"));
  EXPECT_EQ(json["root"]["boundingVolume"], Json::parse(R"({"box":[1,2,7.5,4,0,0,0,4,0,0,0,8.5]})"));
  report.clusters.clear();
  text.clear();
  write_tileset(report, vector_source(report.clusters), TileFrame::cartesian,
                [&](std::string& piece) { text += piece; });
  EXPECT_FALSE(Json::parse(text)["root"].contains("children"));
}

std::string regions_of(const std::vector<Aabb>& boxes) {
  Report report;
  for (const Aabb& box : boxes) {
    report.clusters.emplace_back();
    report.clusters.back().volumes = {{"sphere-exact", Sphere({1, 2, 3}, 4), {}}, {"aabb", box, {}}};
  }
  std::string text;
  write_tileset(report, vector_source(report.clusters), TileFrame::geographic,
                [&](std::string& piece) { text += piece; });
  return text;
}

TEST_F(Tilesets, OfGeographicCloudsHaveRegionsThatEncloseTheirBoxesInExactArithmetic) {
  using Exact = boost::multiprecision::cpp_bin_float_100;
  const Exact radian = boost::math::constants::pi<Exact>() / 180;
  std::mt19937_64 random(53);
  const auto random_within = [&](double limit) {
    return std::uniform_real_distribution<double>(-limit, limit)(random);
  };
  for (int round = 0; round < 2000; ++round) {
    const Eigen::Vector3d one(random_within(180), random_within(90), random_within(9000)),
        other(random_within(180), random_within(90), random_within(9000));
    const Aabb box(one.cwiseMin(other), one.cwiseMax(other));
    const Json root = Json::parse(regions_of({box}))["root"];
    const auto region = root["children"][0]["boundingVolume"]["region"].get<std::vector<double>>();
    ASSERT_EQ(region.size(), 6U);
    EXPECT_EQ(root["boundingVolume"]["region"], root["children"][0]["boundingVolume"]["region"]);
    for (int axis = 0; axis < 2; ++axis) {
      const Exact first = Exact(box.min()[axis]) * radian, last = Exact(box.max()[axis]) * radian;
      const double low = region[static_cast<std::size_t>(axis)];
      const double high = region[static_cast<std::size_t>(axis) + 2];
      EXPECT_LE(Exact(low), first) << round;
      EXPECT_GE(Exact(high), last) << round;
      EXPECT_NEAR(low, first.convert_to<double>(), 2e-15) << round;
      EXPECT_NEAR(high, last.convert_to<double>(), 2e-15) << round;
    }
    EXPECT_EQ(region[4], box.min().z());
    EXPECT_EQ(region[5], box.max().z());
  }
}

TEST_F(Tilesets, OfGeographicCloudsEndAtThePolesAndTheMeridian) {
  const Json earth =
      Json::parse(regions_of({Aabb({-180, -90, -5}, {180, 90, 5}), Aabb({0, 0, 0}, {0, 0, 0})}));
  EXPECT_EQ(earth["root"]["boundingVolume"]["region"].get<std::vector<double>>(),
            (std::vector{-M_PI, -M_PI_2, M_PI, M_PI_2, -5.0, 5.0}));
  EXPECT_EQ(earth["root"]["children"][1]["boundingVolume"], Json::parse(R"({"region":[0,0,0,0,0,0]})"));
  const Json pole = Json::parse(regions_of({Aabb({0, 89, 0}, {0, 90, 0})}));
  EXPECT_GT(pole["geometricError"], 111'690);  // metres of this arc of WGS84: 111 694
  EXPECT_LT(pole["geometricError"], 111'700);
  const auto error = [](const Aabb& box) {
    try {
      return regions_of({box});
    } catch (const IoError& wrong) {
      return std::string(wrong.what());
    }
  };
  EXPECT_THAT(error(Aabb({13, 52, 0}, {180.5, 53, 9})), HasSubstr("longitude 180.5; allowed are -180 to"));
  EXPECT_THAT(error(Aabb({13, -91, 0}, {14, 53, 9})), HasSubstr("latitude -91; allowed are -90 to 90"));
}

}  // namespace
}  // namespace pcl_bv::detail
