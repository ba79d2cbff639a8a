// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/report/meshes.h"

namespace pcl_bv {
namespace {

using Json = nlohmann::json;

struct Glb {
  explicit Glb(const std::string& file) {
    EXPECT_EQ(file.substr(0, 4), "glTF");
    EXPECT_EQ(word(file, 4), 2U);
    EXPECT_EQ(word(file, 8), file.size());
    const std::size_t length = word(file, 12);
    EXPECT_EQ(length % 4, 0U);
    json = Json::parse(file.substr(20, length));
    if (file.size() == 20 + length) return;
    EXPECT_EQ(word(file, 20 + length) + 28 + length, file.size());
    EXPECT_EQ(file.substr(24 + length, 4), std::string("BIN\0", 4));
    binary = file.substr(28 + length);
  }

  static std::size_t word(const std::string& bytes, std::size_t at) {
    std::uint32_t value;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
  }

  /// Returns the values of an accessor.
  template <typename T>
  std::vector<T> values(std::size_t accessor) const {
    const Json& view = json["bufferViews"][json["accessors"][accessor]["bufferView"].get<std::size_t>()];
    std::vector<T> found(view["byteLength"].get<std::size_t>() / sizeof(T));
    std::memcpy(found.data(), binary.data() + view["byteOffset"].get<std::size_t>(),
                found.size() * sizeof(T));
    return found;
  }

  std::vector<double> root_matrix() const { return json["nodes"].back()["matrix"]; }

  Json json;
  std::string binary;
};

ClusterEntry one_volume(const AnyVolume& volume, std::size_t id = 0) {
  ClusterEntry cluster;
  cluster.id = id;
  cluster.points = 5;
  cluster.volumes.push_back({"aabb", volume, {}});
  return cluster;
}

TEST(Glb, HasTheVerticesOfTheMeshesAsFloatsRelativeToAnOrigin) {
  const Aabb box({1e6 + 0.25, 2e6, 30}, {1e6 + 4, 2e6 + 2, 31});
  const Glb glb(volumes_glb({one_volume(box, 7)}));
  EXPECT_EQ(glb.root_matrix(),  // y of glTF is z, z is -y; the origin is the rounded centre
            std::vector<double>({1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 1000002, 31, -2000001, 1}));
  const Mesh expected = box.mesh();
  const auto positions = glb.values<float>(0);
  ASSERT_EQ(positions.size(), 3 * expected.vertices.size());
  const Eigen::Vector3d origin(1000002, 2000001, 31);
  for (std::size_t i = 0; i < positions.size(); ++i)
    EXPECT_EQ(positions[i], static_cast<float>((expected.vertices[i / 3] - origin)[static_cast<int>(i % 3)]));
  EXPECT_EQ(glb.json["accessors"][0]["min"], Json::parse("[-1.75,-1,-1]"));
  EXPECT_EQ(glb.json["accessors"][0]["max"], Json::parse("[2,1,0]"));
  EXPECT_EQ(glb.values<std::uint32_t>(1).size(), 36U);  // twelve triangles
  const Json& node = glb.json["nodes"][0];
  EXPECT_EQ(node["name"], "object 7 aabb");
  EXPECT_EQ(node["extras"], Json::parse(R"({"id":7,"method":"aabb","points":5,"volume":7.5})"));
}

TEST(Glb, HasTrianglesOutwardOfEveryShapeThatAreClosed) {
  std::vector<double> xyz;
  for (int i = 0; i < 300; ++i)
    xyz.insert(xyz.end(), {std::sin(i), std::cos(3 * i), std::sin(7 * i + 1)});
  const PointView points = PointView::of(xyz.data(), 24, 300);
  for (const Method& method : methods()) {
    const Glb glb(volumes_glb({one_volume(*method.fit(points))}));
    const auto xyzs = glb.values<float>(0);
    const auto corners = glb.values<std::uint32_t>(1);
    const auto vertex = [&](std::size_t i) {
      return Eigen::Vector3d(xyzs.at(3 * i), xyzs.at(3 * i + 1), xyzs.at(3 * i + 2));
    };
    double six_volumes = 0;
    for (std::size_t i = 0; i < corners.size(); i += 3)
      six_volumes += vertex(corners[i]).dot(vertex(corners[i + 1]).cross(vertex(corners[i + 2])));
    const double expected = glb.json["nodes"][0]["extras"]["volume"];
    EXPECT_GT(six_volumes / 6, 0.9 * expected) << method.name;  // round shapes are polyhedra
    EXPECT_LT(six_volumes / 6, 1.1 * expected) << method.name;
  }
}

TEST(Glb, HasLinesAndPointsOfFlatVolumes) {
  const Glb line(
      volumes_glb({one_volume(Hull({{0, 0, 0}, {1, 0, 0}}, {}, {{{1, 0, 0}, 1}, {{-1, 0, 0}, 0}}, 1))}));
  const Json primitives = line.json["meshes"][0]["primitives"];
  ASSERT_GE(primitives.size(), 1U);
  EXPECT_LT(primitives[0]["mode"], 4);
  const Glb nothing(volumes_glb({one_volume(Sphere())}));
  EXPECT_FALSE(nothing.json.contains("meshes"));
  EXPECT_FALSE(nothing.json.contains("buffers"));
  EXPECT_FALSE(nothing.json["nodes"][0].contains("children"));
  EXPECT_EQ(nothing.binary, "");
}

TEST(Glb, HasPointsOfTheCloudThinnedAndColouredByCluster) {
  std::vector<float> xyz;
  for (int i = 0; i < 1000; ++i)
    xyz.insert(xyz.end(), {static_cast<float>(i), 0, i == 999 ? NAN : 0.0F});
  GlbCloud cloud;
  cloud.points = PointView::of(xyz.data(), 12, 1000);
  cloud.labels.assign(1000, 3);
  std::fill(cloud.labels.begin() + 500, cloud.labels.end(), kLabelNone);
  cloud.max_points = 100;
  const Glb glb(volumes_glb({one_volume(Aabb({0, 0, 0}, {10, 0, 0}))}, cloud));
  const Json& primitive = glb.json["meshes"].back()["primitives"][0];
  EXPECT_EQ(primitive["mode"], 0);
  const auto positions = glb.values<float>(primitive["attributes"]["POSITION"]);
  ASSERT_EQ(positions.size(), 3U * 99);  // every tenth, without the one that is not finite
  EXPECT_EQ(positions[0], 9.0F - 5);
  EXPECT_EQ(positions[3], 19.0F - 5);
  const auto colours = glb.values<std::uint32_t>(primitive["attributes"]["COLOR_0"]);
  ASSERT_EQ(colours.size(), 99U);
  EXPECT_EQ(colours[49], colours[0]);
  EXPECT_EQ(colours[50], colours[98]);
  EXPECT_NE(colours[0], colours[98]);
  EXPECT_EQ(glb.json["nodes"][1]["name"], "points");
  cloud.up = {0, -2, 0};
  const auto turned = Glb(volumes_glb({}, cloud)).root_matrix();
  EXPECT_NEAR(turned[5], -1, 1e-15);  // y down becomes y up
}

TEST(Glb, RotatesEveryUpToY) {
  const double tiny = 1e-12;
  for (const Eigen::Vector3d& up : std::vector<Eigen::Vector3d>{
           {1, 0, 0}, {0, 3, 0}, {0, -1, 0}, {tiny, -1, tiny}, {tiny, 1, 0}, {0.5, -0.1, 2}, {0, tiny, -1}}) {
    GlbCloud cloud;
    cloud.up = up;
    const std::vector<double> columns = Glb(volumes_glb({}, cloud)).root_matrix();
    const Eigen::Matrix3d rotation = Eigen::Map<const Eigen::Matrix4d>(columns.data()).topLeftCorner<3, 3>();
    EXPECT_TRUE((rotation * up.normalized()).isApprox(Eigen::Vector3d::UnitY(), 1e-15)) << up.transpose();
    EXPECT_TRUE((rotation * rotation.transpose()).isIdentity(1e-15)) << up.transpose();
    EXPECT_NEAR(rotation.determinant(), 1, 1e-15) << up.transpose();
  }
}

}  // namespace
}  // namespace pcl_bv
