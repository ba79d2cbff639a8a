// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tilesets of 3D Tiles and their contents, made for the tests.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "files.h"
#include "pcl_bv/report/tileset.h"

namespace pcl_bv::detail {

using Json = nlohmann::json;

inline std::string read_text(const std::filesystem::path& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return content.str();
}

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

inline std::string word(std::size_t value) {
  return bytes_of(std::vector{static_cast<std::uint32_t>(value)});
}

inline std::string pnts(const std::string& table, const std::string& numbers) {
  return "pnts" + word(1) + word(28 + table.size() + numbers.size()) + word(table.size()) +
         word(numbers.size()) + word(0) + word(0) + table + numbers;
}

inline std::string cloud(const std::vector<float>& xyz, const std::string& more = "") {
  return pnts(R"({"POINTS_LENGTH":)" + std::to_string(xyz.size() / 3) + R"(,"POSITION":{"byteOffset":0})" +
                  more + "}",
              bytes_of(xyz));
}

inline std::string glb(const std::string& json, const std::string& binary) {
  return "glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) + "JSON" + json +
         word(binary.size()) + std::string("BIN\0", 4) + binary;
}

// A glTF of one triangle, whose node has `node`.
inline std::string triangle(const std::string& node, const std::string& accessor = "",
                            const std::string& more = "") {
  return glb(
      R"({"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" + node +
          R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"byteLength":36}],)"
          R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3")" +
          accessor + R"(}],"bufferViews":[{"buffer":0,"byteLength":36}])" + more + "}",
      bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 2, 3}));
}

inline const std::string kUnit = R"({"box":[0,0,0,1,0,0,0,1,0,0,0,1]})";

inline std::string tileset(const std::string& root, const std::string& asset = "") {
  return R"({ "asset": {"version" : "1.1")" + asset + R"(},"zeta":1.50, "root":)" + root + "\n}";
}

inline std::string leaf(const std::string& uri, const std::string& volume = kUnit,
                        const std::string& more = "") {
  return R"({"boundingVolume":)" + volume + R"(,"geometricError":0,"content":{"uri":")" + uri + "\"}" + more +
         "}";
}

class Tilesets : public FileTest {
 protected:
  TilesetUpdate update(const std::string& root, const std::string& asset = "") const {
    write_text(file("tileset.json"), tileset(root, asset));
    return update_tileset(file("tileset.json"), {find_method("aabb")}, {});
  }
  Json root() const { return Json::parse(read_text(file("tileset.json")))["root"]; }
  Json volume() const { return root()["boundingVolume"]; }
  std::vector<double> sphere() const { return volume()["sphere"].get<std::vector<double>>(); }
  std::string problem(const std::string& content) const {
    write_text(file("bad"), content);
    const TilesetUpdate done = update(leaf("bad"));
    EXPECT_EQ(done.updated, 0U);
    EXPECT_EQ(read_text(file("tileset.json")), tileset(leaf("bad")));
    return done.problems.empty() ? "no problem" : done.problems[0];
  }
};

inline const std::vector<float> kPoints{1, 2, 3, 3, 2, 3, 1, 6, 3, 1, 2, 13, 3, 6, 13};

}  // namespace pcl_bv::detail
