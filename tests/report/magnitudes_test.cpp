// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Every writer of volumes and points, with clouds of every magnitude that is valid: coordinates up to 1e100,
// extents from 0 and the smallest denormal number on, and different magnitudes along different axes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/report/box_labels.h"
#include "pcl_bv/report/csv.h"
#include "pcl_bv/report/meshes.h"
#include "pcl_bv/report/picture.h"
#include "pcl_bv/report/tileset.h"
#include "pixels.h"

namespace pcl_bv::detail {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

struct Cloud {
  std::string name;
  std::vector<Eigen::Vector3d> points;

  PointView view() const { return PointView::of(points[0].data(), sizeof points[0], points.size()); }
};

// 20 points in a box from the offset to offset + extent.
Cloud cloud_of(const Eigen::Vector3d& offset, const Eigen::Vector3d& extent) {
  std::ostringstream name;
  name << "offset " << offset.transpose() << ", extent " << extent.transpose();
  Cloud cloud{name.str(), {}};
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d share(i % 3 / 2.0, i % 4 / 3.0, i % 5 / 4.0);
    cloud.points.emplace_back(offset + share.cwiseProduct(extent));
  }
  return cloud;
}

std::vector<Cloud> clouds() {
  std::vector<Cloud> all;
  const Eigen::Vector3d all_ones = Eigen::Vector3d::Ones();
  for (const double offset : {0.0, 0x1p-1074, 1e-300, 1e-40, 5e6, 1e16, 1e20, 1e38, 4e38, 1e100}) {
    for (const double extent : {0.0, 0x1p-1074, 1e-310, 1e-300, 1e-161, 1e-40, 1.0, 1e16, 1e38, 5e38, 1e99}) {
      const double start = offset + extent > 1e100 ? offset - extent : offset;
      all.push_back(cloud_of(start * all_ones, extent * all_ones));
    }
  }
  for (const Eigen::Vector3d& extent :
       {Eigen::Vector3d(1e-300, 1, 1e99), {1e99, 1e-310, 0}, {1, 1e20, 1e-20}}) {
    all.push_back(cloud_of({0, 0, 0}, extent));
    all.push_back(cloud_of({1e20, -5e6, 1e-300}, extent));
  }
  return all;
}

Report report_of(const Cloud& cloud) {
  Report report;
  report.file = "cloud";
  report.points = cloud.points.size();
  report.clusters.resize(1);
  report.clusters[0].points = report.points;
  for (const Method& method : methods())
    report.clusters[0].volumes.push_back({std::string(method.name), method.fit(cloud.view()).volume, {}});
  return report;
}

// Returns what write(sink) writes. If a writer refuses a cloud, returns an empty text; the reason must then
// be a line.
template <typename Write>
std::string written(const Write& write) {
  std::string text;
  try {
    write([&](std::string& piece) { text += piece; });
  } catch (const std::domain_error& refused) {
    EXPECT_THAT(refused.what(), Not(HasSubstr("\n")));
    return {};
  } catch (const IoError& refused) {
    EXPECT_THAT(refused.what(), Not(HasSubstr("\n")));
    return {};
  }
  return text;
}

void expect_json(const std::string& text) {
  EXPECT_TRUE(text.empty() || nlohmann::json::accept(text)) << text.substr(0, 300);
}

void expect_numbers(const std::string& text) {
  EXPECT_THAT(text, Not(ContainsRegex("(^|[ ,\n])-?(nan|inf)")));
}

// These pictures are too small for axes and a scale bar, so that what differs from the background is points.
TEST(Magnitudes, PicturesShowEveryCloudFromEverySide) {
  const std::string background = picture_png(test::sized(320, 200));
  for (const Cloud& cloud : clouds()) {
    SCOPED_TRACE(cloud.name);
    for (const ViewFrom from : {ViewFrom::iso, ViewFrom::top, ViewFrom::front, ViewFrom::side}) {
      Picture picture = test::sized(320, 200, from);
      picture.points = cloud.view();
      const bool is_origin = cloud.points[0].isZero(0) && cloud.points[19].isZero(0);
      EXPECT_EQ(test::difference(picture_png(picture), background) == 0, is_origin);
    }
  }
}

TEST(Magnitudes, PicturesOfVolumesAreDrawn) {
  for (const Cloud& cloud : clouds()) {
    SCOPED_TRACE(cloud.name);
    const Report report = report_of(cloud);
    const std::vector<std::uint32_t> labels(cloud.points.size(), 0);
    Picture picture = test::sized(480, 320, ViewFrom::front);
    picture.points = cloud.view();
    std::uint32_t number = 0;
    for (const VolumeEntry& entry : report.clusters[0].volumes) {
      picture.methods.push_back(entry.method);
      picture.volumes.push_back({entry.volume, number, entry.method, number});
      ++number;
    }
    EXPECT_EQ(test::decode(picture_png(picture)).width, 480);
    picture.labels = labels.data();
    EXPECT_EQ(test::decode(picture_png(picture)).height, 320);
    expect_numbers(picture_svg(picture));
  }
}

TEST(Magnitudes, ReportsAreTextOfFiniteNumbers) {
  for (const Cloud& cloud : clouds()) {
    SCOPED_TRACE(cloud.name);
    const Report report = report_of(cloud);
    const std::string json = report_json(report), csv = report_csv(report);
    expect_json(json);
    EXPECT_THAT(json, Not(HasSubstr("null")));
    expect_numbers(csv);
    EXPECT_THAT(report_text(report), Not(ContainsRegex("nan|inf")));
  }
}

TEST(Magnitudes, MeshesHaveFiniteVerticesOrAreRefusedInALine) {
  for (const Cloud& cloud : clouds()) {
    SCOPED_TRACE(cloud.name);
    const std::vector<ClusterEntry> clusters = report_of(cloud).clusters;
    EXPECT_FALSE(written([&](const auto& take) {
                   std::string ply = volumes_ply(clusters);
                   take(ply);
                 }).empty());
    const std::string vtp = written([&](const auto& take) {
      std::string text = volumes_vtp(clusters);
      take(text);
    });
    EXPECT_FALSE(vtp.empty());
    expect_numbers(vtp);
    expect_numbers(points_vtp(cloud.view(), std::vector<std::uint32_t>(cloud.points.size(), 0)));
    GlbCloud shown;
    shown.points = cloud.view();
    const std::string glb = written([&](const auto& take) {
      std::string file = volumes_glb(clusters, shown);
      take(file);
    });
    if (glb.empty()) continue;
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, 4);
    expect_json(glb.substr(20, length));
  }
}

TEST(Magnitudes, TilesetsAndLabelsAreJsonOrAreRefusedInALine) {
  for (const Cloud& cloud : clouds()) {
    SCOPED_TRACE(cloud.name);
    const Report report = report_of(cloud);
    const ClusterSource clusters = vector_source(report.clusters);
    for (const TileFrame frame : {TileFrame::cartesian, TileFrame::geographic})
      expect_json(written([&](const auto& take) { write_tileset(report, clusters, frame, take); }));
    for (const auto format : {BoxLabelFormat::kitti, BoxLabelFormat::kitti_tracking, BoxLabelFormat::nuscenes,
                              BoxLabelFormat::openlabel, BoxLabelFormat::sustech}) {
      const std::string text = written([&](const auto& take) {
        write_box_labels(report, clusters, format, BoxLabelOptions{"Car", 7}, take);
      });
      const bool is_json = format != BoxLabelFormat::kitti && format != BoxLabelFormat::kitti_tracking;
      EXPECT_FALSE(text.empty());
      expect_numbers(text);
      const auto [begin, between, end] = box_label_file(format);
      if (is_json) expect_json(std::string(begin) + text + std::string(end));
    }
  }
}

TEST(Magnitudes, AnyUpDirectionGivesARotationInGltf) {
  const Cloud cloud = cloud_of({0, 0, 0}, {1, 2, 3});
  for (const double length : {1e-310, 1e-200, 1.0, 1e200}) {
    GlbCloud shown;
    shown.up = length * Eigen::Vector3d(0, -1, -1);
    const std::string glb = volumes_glb(report_of(cloud).clusters, shown);
    std::uint32_t bytes = 0;
    std::memcpy(&bytes, glb.data() + 12, 4);
    const std::vector<double> matrix = nlohmann::json::parse(glb.substr(20, bytes))["nodes"].back()["matrix"];
    const Eigen::Matrix4d m = Eigen::Matrix4d::Map(matrix.data());
    EXPECT_TRUE((m.topLeftCorner<3, 3>().isUnitary(1e-12))) << length << "\n" << m;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
