// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Small files that name much: time and memory grow with the bytes, or a limit is said.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "growth.h"
#include "pcl_bv/io/untrusted_text.h"
#include "tile_files.h"

namespace pcl_bv::detail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string repeated(const std::string& text, std::size_t times) {
  std::string all;
  for (std::size_t i = 0; i < times; ++i)
    all += (i == 0 ? "" : ",") + text;
  return all;
}

// Nodes that all show one mesh, whose primitives have the given accessors.
std::string shared_mesh(std::size_t nodes, const std::string& primitives, const std::string& accessors) {
  std::string numbers;
  for (std::size_t i = 0; i < nodes; ++i)
    numbers += (i == 0 ? "" : ",") + std::to_string(i);
  return glb(R"({"scene":0,"scenes":[{"nodes":[)" + numbers + R"(]}],"nodes":[)" +
                 repeated(R"({"mesh":0})", nodes) + R"(],"meshes":[{"primitives":[)" + primitives +
                 R"(]}],"buffers":[{"byteLength":36}],"accessors":[)" + accessors +
                 R"(],"bufferViews":[{"buffer":0,"byteLength":36}]})",
             bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 2, 3}));
}

const std::string kAccessor = R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})";

using TilesetGrowth = Tilesets;

TEST_F(TilesetGrowth, OfNodesTimesPrimitivesOfOneMeshIsThatOfTheFile) {
  test::expect_linear(
      "nodes and primitives of one mesh", 2000, 100,
      [&](std::size_t n) {
        const std::string bytes = shared_mesh(n, repeated(R"({"attributes":{"POSITION":0}})", n), kAccessor);
        write_text(file("a.glb"), bytes);
        return bytes.size();
      },
      [&] { EXPECT_THAT(update(leaf("a.glb")).problems, IsEmpty()); });
  EXPECT_EQ(volume(), Json::parse(R"({"box":[0.5,-1.5,1,0.5,0,0,0,1.5,0,0,0,1]})"));
}

TEST_F(TilesetGrowth, OfNodesTimesAccessorsEndsAtALimitThatIsSaid) {
  std::string primitives;
  for (std::size_t i = 0; i < 2000; ++i)
    primitives += (i == 0 ? "" : ",") + (R"({"attributes":{"POSITION":)" + std::to_string(i) + "}}");
  write_text(file("a.glb"), shared_mesh(8000, primitives, repeated(kAccessor, 2000)));
  largest_allocation = 0;
  const TilesetUpdate done = update(leaf("a.glb"));
  EXPECT_THAT(done.problems, ElementsAre(HasSubstr("a.glb: its nodes show more than ")));
  EXPECT_LT(done.problems[0].size(), 200U);
  EXPECT_LT(largest_allocation.load(), 100 * std::filesystem::file_size(file("a.glb")));
}

TEST_F(TilesetGrowth, OfAUriIsThatOfItsBytesAndItsProblemIsShort) {
  for (const std::string part : {"a", "../", "%20", "b/"}) {
    std::string uri;
    while (uri.size() < 3'000'000)
      uri += part;
    const TilesetUpdate done = update(leaf(uri + ".b3dm"));
    ASSERT_EQ(done.problems.size(), 1U);
    EXPECT_LE(done.problems[0].size(), kMaxMessageBytes);
    EXPECT_THAT(done.problems[0], HasSubstr(".b3dm: ")) << part;
  }
}

TEST_F(TilesetGrowth, OfContentsThatAreOneFileIsThatOfOne) {
  write_text(file("a.pnts"), cloud(std::vector<float>(30'000, 1)));
  test::expect_linear(
      "contents of one tile that are one file", 500, 400,
      [&](std::size_t n) {
        write_text(file("tileset.json"),
                   tileset(R"({"boundingVolume":)" + kUnit + R"(,"contents":[)" +
                           repeated(R"({"uri":"a.pnts","boundingVolume":)" + kUnit + "}", n) + "]}"));
        return std::filesystem::file_size(file("tileset.json"));
      },
      [&] {
        EXPECT_THAT(update_tileset(file("tileset.json"), {find_method("aabb")}, {}).problems, IsEmpty());
      });
}

TEST_F(TilesetGrowth, OfTilesThatNameALargeFileEndsAtALimitThatIsSaid) {
  write_text(file("a.pnts"), "pnts");
  std::filesystem::resize_file(file("a.pnts"), std::size_t{64} << 20);  // without a byte on the disk
  const std::string root =
      R"({"boundingVolume":)" + kUnit + R"(,"children":[)" + repeated(leaf("a.pnts"), 100) + "]}";
  try {
    update(root);
    FAIL() << "no error";
  } catch (const IoError& error) {
    EXPECT_THAT(error.what(), HasSubstr("names the same contents too often"));
  }
  EXPECT_EQ(read_text(file("tileset.json")), tileset(root));
}

TEST_F(TilesetGrowth, OfTilesIsThatOfTheFile) {
  write_text(file("a.pnts"), cloud(kPoints));
  test::expect_linear(
      "tiles", 500, 400,
      [&](std::size_t n) {
        write_text(file("tileset.json"), tileset(R"({"boundingVolume":)" + kUnit + R"(,"children":[)" +
                                                 repeated(leaf("a.pnts"), n) + "]}"));
        return std::filesystem::file_size(file("tileset.json"));
      },
      [&] {
        EXPECT_EQ(update_tileset(file("tileset.json"), {find_method("aabb")}, {}).problems.size(), 0U);
      });
}

}  // namespace
}  // namespace pcl_bv::detail
