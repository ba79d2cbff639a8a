// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The format is what PCL's own reader and writer make of it.
#include <gtest/gtest.h>
#include <pcl/console/print.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>

#include "files.h"
#include "pcl_bv/io/list_clouds.h"
#include "pcl_bv/io/read_cloud.h"
#include "sample_clouds.h"

namespace pcl_bv::detail {
namespace {

namespace fs = std::filesystem;

const PcdEncoding encodings[] = {PcdEncoding::ascii, PcdEncoding::binary, PcdEncoding::binary_compressed};

PointField from_pcl(const pcl::PCLPointField& field) {
  using Type = pcl::PCLPointField;
  const bool is_float = field.datatype == Type::FLOAT32 || field.datatype == Type::FLOAT64;
  const bool is_signed = field.datatype == Type::INT8 || field.datatype == Type::INT16 ||
                         field.datatype == Type::INT32 || field.datatype == Type::INT64;
  const int size = pcl::getFieldSize(field.datatype);
  return {field.name,
          is_float    ? 'F'
          : is_signed ? 'I'
                      : 'U',
          static_cast<std::uint32_t>(size), field.count, field.offset};
}

struct PclCloud {
  pcl::PCLPointCloud2 points;
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
};

PclCloud read_by_pcl(const fs::path& path) {
  PclCloud cloud;
  int version = 0;
  if (pcl::PCDReader().read(path.string(), cloud.points, cloud.origin, cloud.orientation, version) < 0) {
    throw std::runtime_error("PCL cannot read " + path.string());
  }
  return cloud;
}

RawCloud from_pcl(const PclCloud& cloud) {
  RawCloud result;
  for (const auto& field : cloud.points.fields)
    result.fields.push_back(from_pcl(field));
  result.width = cloud.points.width;
  result.height = cloud.points.height;
  const auto& o = cloud.origin;
  const auto& q = cloud.orientation;
  result.viewpoint = {o[0], o[1], o[2], q.w(), q.x(), q.y(), q.z()};
  result.point_step = cloud.points.point_step;
  const auto* bytes = reinterpret_cast<const std::byte*>(cloud.points.data.data());
  result.data.assign(bytes, bytes + cloud.points.data.size());
  return result;
}

class PcdAgainstPcl : public FileTest {
 protected:
  PcdAgainstPcl() { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }

  // Writes by PCL in each encoding; each must read back, by us, as what was written.
  template <typename PointT>
  void expect_we_read(const pcl::PointCloud<PointT>& cloud) const {
    PclCloud expected;
    pcl::toPCLPointCloud2(cloud, expected.points);
    expected.origin = cloud.sensor_origin_;
    expected.orientation = cloud.sensor_orientation_;
    pcl::PCDWriter writer;
    writer.writeASCII(file("0.pcd").string(), cloud, 9);
    writer.writeBinary(file("1.pcd").string(), cloud);
    writer.writeBinaryCompressed(file("2.pcd").string(), cloud);
    for (int encoding = 0; encoding < 3; ++encoding) {
      SCOPED_TRACE("encoding " + std::to_string(encoding));
      RawCloud actual = read_pcd(file(std::to_string(encoding) + ".pcd"));
      expect_same_cloud(actual, from_pcl(expected), false);
      EXPECT_EQ(actual.xyz().count, cloud.size());
    }
  }
};

template <typename PointT>
pcl::PointCloud<PointT> random_points(std::uint32_t width, std::uint32_t height) {
  std::mt19937 random(31);
  std::uniform_real_distribution<float> value(-100, 100);
  pcl::PointCloud<PointT> cloud(width, height);
  for (PointT& point : cloud) {
    point.x = value(random);
    point.y = value(random);
    point.z = value(random);
  }
  cloud.sensor_origin_ = Eigen::Vector4f(1, 2, 3.5f, 0);
  cloud.sensor_orientation_ = Eigen::Quaternionf(0.5f, 0.5f, -0.5f, 0.5f);
  return cloud;
}

TEST_F(PcdAgainstPcl, WeReadPointsThatPclWrites) {
  auto cloud = random_points<pcl::PointXYZ>(50, 3);
  cloud[7].x = cloud[7].y = cloud[7].z = std::numeric_limits<float>::quiet_NaN();
  expect_we_read(cloud);
}

TEST_F(PcdAgainstPcl, WeReadNormalsThatPclWrites) {
  expect_we_read(random_points<pcl::PointNormal>(40, 1));
}

TEST_F(PcdAgainstPcl, WeReadLabelsThatPclWrites) {
  auto cloud = random_points<pcl::PointXYZL>(40, 1);
  for (auto& point : cloud)
    point.label = 4294967295u - static_cast<std::uint32_t>(&point - &cloud[0]);
  expect_we_read(cloud);
}

TEST_F(PcdAgainstPcl, WeReadColoursThatPclWrites) {
  auto cloud = random_points<pcl::PointXYZRGBA>(40, 1);
  for (auto& point : cloud)
    point.rgba = 0xff102030u + static_cast<std::uint32_t>(&point - &cloud[0]);
  expect_we_read(cloud);
}

// PCL's own converter keeps the padding of its 16-byte points as gaps, which its writer names "_".
TEST_F(PcdAgainstPcl, WeReadThePaddingThatPclWrites) {
  pcl::PCLPointCloud2 cloud;
  pcl::toPCLPointCloud2(random_points<pcl::PointNormal>(20, 2), cloud);
  ASSERT_EQ(cloud.point_step, 48u);
  pcl::PCDWriter().writeBinary(file("a.pcd").string(), cloud);
  const RawCloud actual = read_pcd(file("a.pcd"));
  EXPECT_NE(find_field(actual, "_"), nullptr);
  EXPECT_EQ(actual.point_step, cloud.point_step);
  EXPECT_EQ(std::memcmp(actual.data.data(), cloud.data.data(), cloud.data.size()), 0);
}

// PCL 1.13 reads 64-bit integers of ascii files by way of double: 5000000000000000001 comes out as 5e18.
void keep_integers_below_2_48(RawCloud& cloud) {
  for (const PointField& field : cloud.fields) {
    if (field.size != 8 || field.type == 'F') continue;
    for (std::size_t point = 0; point < cloud.size(); ++point) {
      for (std::uint32_t i = 0; i < field.count; ++i) {
        std::memset(&cloud.data[point * cloud.point_step + field.offset + i * 8 + 6], 0, 2);
      }
    }
  }
}

TEST_F(PcdAgainstPcl, PclReadsWhatWeWrite) {
  for (const Layout& layout : sample_layouts()) {
    for (const PcdEncoding encoding : encodings) {
      SCOPED_TRACE(layout.name + ", encoding " + std::to_string(static_cast<int>(encoding)));
      RawCloud cloud = sample_cloud(layout, 25, 4, 37);
      cloud.viewpoint = {1, 2, 3.5, 0.5, 0.5, -0.5, 0.5};
      keep_integers_below_2_48(cloud);
      write_pcd(file("a.pcd"), cloud, encoding);
      expect_same_cloud(from_pcl(read_by_pcl(file("a.pcd"))), cloud, false);
    }
  }
}

TEST_F(PcdAgainstPcl, RealCloudsReadAsPclReadsThem) {
  const char* data = std::getenv("PCL_BV_DATA");
  if (!data) GTEST_SKIP() << "PCL_BV_DATA is not set";
  int clouds = 0;
  for (const char* name : {"objects", "organized", "sensors", "lidar_sequence"}) {
    for (const fs::path& path : list_clouds(fs::path(data) / name)) {
      SCOPED_TRACE(path.string());
      const RawCloud actual = read_pcd(path);
      expect_same_cloud(actual, from_pcl(read_by_pcl(path)));
      EXPECT_EQ(actual.xyz().count, actual.size());
      ++clouds;
    }
  }
  EXPECT_GT(clouds, 0);
}

}  // namespace
}  // namespace pcl_bv::detail
