// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The up axis of glTF contents, and the bounding volumes of contents.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tile_files.h"

namespace pcl_bv::detail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string box_of(const std::string& numbers) {
  return R"({"box":[)" + numbers + "]}";
}

// A content, with a bounding volume if there is one.
std::string content(const std::string& uri, const std::string& volume = "") {
  return R"({"uri":")" + uri + "\"" + (volume.empty() ? "" : R"(,"boundingVolume":)" + volume) + "}";
}

// A tile with more keys.
std::string tile(const std::string& keys, const std::string& volume = kUnit) {
  return R"({"boundingVolume":)" + volume + R"(,"geometricError":0,)" + keys + "}";
}

std::string b3dm(const std::string& table, const std::string& inner) {
  return "b3dm" + word(1) + word(28 + table.size() + inner.size()) + word(table.size()) + word(0) + word(0) +
         word(0) + table + inner;
}

// The corners of a box of a tileset.
std::vector<Eigen::Vector3d> corners_in(const Json& box) {
  const auto three = [&](std::size_t i) {
    return Eigen::Vector3d(box[i].get<double>(), box[i + 1].get<double>(), box[i + 2].get<double>());
  };
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(three(0) + ((i & 1) != 0 ? 1 : -1) * three(3) + ((i & 2) != 0 ? 1 : -1) * three(6) +
                      ((i & 4) != 0 ? 1 : -1) * three(9));
  return corners;
}

using TilesetContents = Tilesets;

TEST_F(TilesetContents, OfGltfAreTurnedFromTheirUpAxis) {
  write_text(file("a.glb"), triangle(""));
  const std::string y = "0.5,-1.5,1,0.5,0,0,0,1.5,0,0,0,1", z = "0.5,1,1.5,0.5,0,0,0,1,0,0,0,1.5",
                    x = "-1.5,1,0.5,1.5,0,0,0,1,0,0,0,0.5";
  for (const auto& [axis, numbers] : {std::pair("Z", z), {"z", z}, {"X", x}, {"x", x}, {"Y", y}, {"y", y}}) {
    EXPECT_THAT(update(leaf("a.glb"), std::string(R"(,"gltfUpAxis":")") + axis + '"').problems, IsEmpty());
    EXPECT_EQ(volume(), Json::parse(box_of(numbers))) << axis;
  }
  update(leaf("a.glb"));
  EXPECT_EQ(volume(), Json::parse(box_of(y)));
  for (const std::string wrong : {R"("W")", R"("")", "2", "null"})
    EXPECT_THROW(update(leaf("a.glb"), R"(,"gltfUpAxis":)" + wrong), IoError) << wrong;
}

TEST_F(TilesetContents, KeepTheirCenterAndPointsInTheFrameOfTheTile) {
  const std::string axis = R"(,"gltfUpAxis":"Z")";
  write_text(file("a.b3dm"), b3dm(R"({"RTC_CENTER":[100,200,300],"BATCH_LENGTH":0})", triangle("")));
  update(leaf("a.b3dm"), axis);
  EXPECT_EQ(volume(), Json::parse(box_of("100.5,201,301.5,0.5,0,0,0,1,0,0,0,1.5")));
  update(leaf("a.b3dm"), R"(,"gltfUpAxis":"X")");
  EXPECT_EQ(volume(), Json::parse(box_of("98.5,201,300.5,1.5,0,0,0,1,0,0,0,0.5")));
  write_text(file("a.pnts"), cloud(kPoints));
  update(leaf("a.pnts"), axis);
  EXPECT_EQ(volume(), Json::parse(box_of("2,4,8,1,0,0,0,2,0,0,0,5")));
  const std::string moved = R"(,"transform":[0,1,0,0,-1,0,0,0,0,0,1,0,10,0,0,1])";
  write_text(file("a.glb"), triangle(""));
  update(tile(R"("children":[)" + leaf("a.glb", kUnit, moved) + "]"), axis);
  EXPECT_EQ(volume(), Json::parse(box_of("9,0.5,1.5,1,0,0,0,0.5,0,0,0,1.5")));
}

TEST_F(TilesetContents, HaveTheirOwnVolumesOfTheirKindsComputedAnew) {
  write_text(file("a.pnts"), cloud(kPoints));
  const std::string fitted = box_of("2,4,8,1,0,0,0,2,0,0,0,5");
  for (const std::string old : {"0.1", "50"}) {
    const auto text = [&](const std::string& volume, const std::string& own) {
      return tile(R"("content":)" + content("a.pnts", own) + R"(,"viewerRequestVolume":{"box":[7]})", volume);
    };
    const std::string box = box_of("0,0,0," + old + ",0,0,0," + old + ",0,0,0," + old);
    EXPECT_THAT(update(text(kUnit, box)).problems, IsEmpty());
    EXPECT_EQ(read_text(file("tileset.json")), tileset(text(fitted, fitted)));
  }
  update(tile(R"("content":)" + content("a.pnts", R"({"sphere":[0,0,0,1],"extras":{"a" : 1}})")));
  EXPECT_THAT(root()["content"]["boundingVolume"]["sphere"].get<std::vector<double>>(),
              ElementsAre(2, 4, 8, testing::DoubleNear(std::sqrt(30), 1e-12)));
  EXPECT_EQ(root()["content"]["boundingVolume"]["extras"]["a"], 1);
  // The tile encloses the sphere.
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_GE(volume()["box"][static_cast<std::size_t>(3 + 4 * axis)].get<double>(), std::sqrt(30) - 1e-12);
}

TEST_F(TilesetContents, HaveRegionsOfTheirOwnPoints) {
  write_text(file("a.pnts"), cloud({0, 0, 0, 50, 0, 0}));
  write_text(file("b.pnts"), cloud({0, 1000, 0}));
  const std::string region = R"({"region":[0,0,0,0,0,0]})";
  update(tile(R"("contents":[)" + content("a.pnts", region) + "," + content("b.pnts", region) +
                  R"(],"transform":[1,0,0,0,0,1,0,0,0,0,1,0,6378137,0,0,1])",
              region));
  const auto numbers = [](const Json& volume) { return volume["region"].get<std::vector<double>>(); };
  const std::vector<double> a = numbers(root()["contents"][0]["boundingVolume"]),
                            b = numbers(root()["contents"][1]["boundingVolume"]), all = numbers(volume());
  EXPECT_NEAR(a[5], 50, 1e-6);
  EXPECT_NEAR(b[0], 1000 / 6378137.0, 1e-10);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(all[i], i < 2 || i == 4 ? std::min(a[i], b[i]) : std::max(a[i], b[i])) << i;
}

TEST_F(TilesetContents, OfOneTileEachHaveAVolumeInsideTheTilesVolume) {
  write_text(file("a.pnts"), cloud(kPoints));
  write_text(file("b.glb"), triangle(""));
  const std::string both = content("a.pnts", kUnit) + "," + content("b.glb", R"({"sphere":[0,0,0,1]})");
  for (const std::string& keys :
       {R"("contents":[)" + both + "]",
        R"("extensions":{"3DTILES_multiple_contents":{"contents":[)" + both + "]}}",
        R"("extensions":{"3DTILES_multiple_contents":{"content":[)" + both + "]}}"}) {
    EXPECT_THAT(update(tile(keys)).problems, IsEmpty());
    const Json found = root();
    const Json contents = found.contains("contents")
                              ? found["contents"]
                              : found["extensions"]["3DTILES_multiple_contents"].front();
    EXPECT_EQ(contents[0]["boundingVolume"], Json::parse(box_of("2,4,8,1,0,0,0,2,0,0,0,5")));
    const auto sphere = contents[1]["boundingVolume"]["sphere"].get<std::vector<double>>();
    EXPECT_NEAR(sphere[3], std::sqrt(0.25 + 2.25 + 1), 1e-12);
    const Json box = found["boundingVolume"]["box"];
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const double low = box[k].get<double>() - box[3 + 4 * k].get<double>(),
                   high = box[k].get<double>() + box[3 + 4 * k].get<double>();
      EXPECT_LE(low, sphere[k] - sphere[3]);
      EXPECT_GE(high, sphere[k] + sphere[3]);
      for (const Eigen::Vector3d& corner : corners_in(contents[0]["boundingVolume"]["box"])) {
        EXPECT_LE(low, corner[axis]);
        EXPECT_GE(high, corner[axis]);
      }
    }
  }
}

TEST_F(TilesetContents, WithVolumesThatCannotBeComputedAreReported) {
  write_text(file("a.pnts"), cloud(kPoints));
  const std::string s2 = R"({"extensions":{"3DTILES_bounding_volume_S2":{"token":"1"}}})",
                    both = R"({"box":[0,0,0,1,0,0,0,1,0,0,0,1],"sphere":[0,0,0,9]})";
  for (const std::string& own : {s2, both}) {
    const TilesetUpdate done = update(tile(R"("content":)" + content("a.pnts", own)));
    EXPECT_THAT(done.problems, ElementsAre(HasSubstr("a.pnts: its bounding volume stays"))) << own;
    EXPECT_EQ(root()["content"]["boundingVolume"], Json::parse(own));
    EXPECT_EQ(done.updated, 1U);
  }
  const std::string missing = tile(R"("content":)" + content("missing.pnts", kUnit));
  EXPECT_THAT(update(missing).problems, ElementsAre(HasSubstr("missing.pnts: no such file")));
  EXPECT_EQ(read_text(file("tileset.json")), tileset(missing));
  const std::string external = R"("contents":[)" + content("a.pnts", kUnit) + "," + content("b.json") + "]";
  EXPECT_THAT(update(tile(external)).problems, ElementsAre(HasSubstr("a.pnts: its bounding volume stays")));
  EXPECT_EQ(read_text(file("tileset.json")), tileset(tile(external)));
}

TEST_F(TilesetContents, AreNotFoundOutForImplicitTilesWhichKeepTheirVolume) {
  write_text(file("a.pnts"), cloud(kPoints));
  for (const std::string keys :
       {R"("content":{"uri":"a.pnts"},"implicitTiling":{"subdivisionScheme":"QUADTREE"})",
        R"("content":{"uri":"a.pnts"},"extensions":{"3DTILES_implicit_tiling":{}})"}) {
    EXPECT_THAT(update(tile(keys)).problems, ElementsAre(HasSubstr("implicit tiling")));
    EXPECT_EQ(read_text(file("tileset.json")), tileset(tile(keys)));
  }
}

TEST_F(TilesetContents, OfTilesetsWithKeysThatMoveThemAreRefused) {
  write_text(file("a.pnts"), cloud(kPoints));
  const auto refusal = [&](const std::string& keys) {
    const std::string text = R"({"asset":{"version":"1.1"},)" + keys + R"(,"root":)" + leaf("a.pnts") + "}";
    write_text(file("tileset.json"), text);
    try {
      update_tileset(file("tileset.json"), {find_method("aabb")}, {});
    } catch (const IoError& error) {
      EXPECT_EQ(read_text(file("tileset.json")), text);
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_THAT(refusal(R"("extensionsRequired":["VENDOR_moves"])"), HasSubstr("VENDOR_moves"));
  EXPECT_EQ(refusal(R"("extensionsRequired":["3DTILES_content_gltf"])"), "none");
  EXPECT_THAT(refusal(R"("extensions":{"3DTILES_ellipsoid":{}})"), HasSubstr("ellipsoid"));
  write_text(file("bad"), triangle("", "", R"(,"animations":[{}])"));
  EXPECT_THAT(update(leaf("bad")).problems, ElementsAre(HasSubstr("animations")));
  write_text(file("bad"), triangle(R"(,"weights":[1])"));
  EXPECT_THAT(update(leaf("bad")).problems, ElementsAre(HasSubstr("morph targets")));
}

TEST_F(TilesetContents, OfTilesWhoseMetadataMayReplaceVolumesKeepTheirs) {
  write_text(file("a.pnts"), cloud(kPoints));
  const auto problems = [&](const std::string& schema, const std::string& keys) {
    write_text(file("tileset.json"), R"({"asset":{"version":"1.1"},)" + schema + R"(,"root":)" +
                                         tile(R"("content":{"uri":"a.pnts"})" + keys) + "}");
    return update_tileset(file("tileset.json"), {find_method("aabb")}, {}).problems;
  };
  const std::string metadata = R"(,"metadata":{"class":"t"})",
                    box =
                        R"("schema":{"classes":{"t":{"properties":{"b":{"semantic":"TILE_BOUNDING_BOX"}}}}})";
  EXPECT_THAT(problems(box, metadata), ElementsAre(HasSubstr("metadata")));
  EXPECT_THAT(problems(R"("schemaUri":"s.json")", metadata), ElementsAre(HasSubstr("metadata")));
  EXPECT_THAT(problems(box, ""), IsEmpty());
  EXPECT_THAT(problems(R"("schema":{"classes":{"t":{}}})", metadata), IsEmpty());
}

TEST_F(TilesetContents, MayHaveEscapesInTheirKeys) {
  write_text(file("a.pnts"), cloud(kPoints));
  update(R"({"bounding\u0056olume":)" + kUnit + R"(,"conten\u0074":{"ur\u0069":"a.pnts"}})");
  EXPECT_EQ(volume(), Json::parse(box_of("2,4,8,1,0,0,0,2,0,0,0,5")));
}

}  // namespace
}  // namespace pcl_bv::detail
