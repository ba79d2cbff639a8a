// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// .ply files of PCL's own writer, with all that it puts around the points.
#include <gtest/gtest.h>
#include <pcl/console/print.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "files.h"
#include "pcl_bv/io/ply.h"
#include "sample_clouds.h"

namespace pcl_bv::detail {
namespace {

pcl::PointCloud<pcl::PointXYZRGBNormal> random_points() {
  std::mt19937 random(31);
  std::uniform_real_distribution<float> value(-100, 100);
  pcl::PointCloud<pcl::PointXYZRGBNormal> cloud(30, 4);
  for (auto& point : cloud) {
    for (float* coordinate : {&point.x, &point.y, &point.z, &point.normal_x, &point.curvature})
      *coordinate = value(random);
    point.r = static_cast<std::uint8_t>(random());
    point.g = static_cast<std::uint8_t>(random());
    point.b = static_cast<std::uint8_t>(random());
  }
  return cloud;
}

bool same(float a, float b) {
  return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}

std::uint8_t byte_at(const RawCloud& cloud, const char* field, std::size_t point) {
  return static_cast<std::uint8_t>(
      cloud.data.at(point * cloud.point_step + find_field(cloud, field)->offset));
}

// PCL's writer rounds ascii to 8 digits, which is not enough for floats: those are compared with what PCL
// reads back.
class PlyAgainstPcl : public FileTest {
 protected:
  PlyAgainstPcl() { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }

  void expect_we_read_as_pcl_does() const {
    pcl::PointCloud<pcl::PointXYZRGBNormal> expected;
    ASSERT_EQ(pcl::PLYReader().read(file("a.ply").string(), expected), 0);
    const RawCloud cloud = read_ply(file("a.ply"));
    ASSERT_EQ(cloud.size(), expected.size());
    ASSERT_EQ(cloud.xyz().count, expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const auto& point = expected[i];
      ASSERT_TRUE(same(float_at(cloud, "x", i), point.x)) << i;
      ASSERT_TRUE(same(float_at(cloud, "y", i), point.y)) << i;
      ASSERT_TRUE(same(float_at(cloud, "z", i), point.z)) << i;
      ASSERT_TRUE(same(float_at(cloud, "nx", i), point.normal_x)) << i;
      ASSERT_TRUE(same(float_at(cloud, "curvature", i), point.curvature)) << i;
      ASSERT_EQ(byte_at(cloud, "red", i), point.r);
      ASSERT_EQ(byte_at(cloud, "green", i), point.g);
      ASSERT_EQ(byte_at(cloud, "blue", i), point.b);
    }
  }

  void expect_we_read(bool binary, bool camera) const {
    auto cloud = random_points();
    // With a grid PCL leaves bad points out of the vertices, and puts them back when it reads.
    if (camera) cloud[7].x = cloud[7].y = cloud[7].z = std::numeric_limits<float>::quiet_NaN();
    pcl::PCLPointCloud2 blob;
    pcl::toPCLPointCloud2(cloud, blob);
    pcl::PLYWriter().write(file("a.ply").string(), blob, Eigen::Vector4f::Zero(),
                           Eigen::Quaternionf::Identity(), binary, camera);
    expect_we_read_as_pcl_does();
  }
};

TEST_F(PlyAgainstPcl, WeReadTheAsciiThatPclWritesWithACamera) {
  expect_we_read(false, true);
}
TEST_F(PlyAgainstPcl, WeReadTheAsciiThatPclWritesWithAGrid) {
  expect_we_read(false, false);
}
TEST_F(PlyAgainstPcl, WeReadTheBinaryThatPclWritesWithACamera) {
  expect_we_read(true, true);
}

TEST_F(PlyAgainstPcl, WeReadTheBinaryThatPclWritesToTheBit) {
  const auto written = random_points();
  pcl::PLYWriter().write(file("a.ply").string(), written, true, false);
  const RawCloud cloud = read_ply(file("a.ply"));
  ASSERT_EQ(cloud.size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    ASSERT_TRUE(same(float_at(cloud, "x", i), written[i].x)) << i;
    ASSERT_TRUE(same(float_at(cloud, "z", i), written[i].z)) << i;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
