// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reports as CSV: the columns of each shape, fields that need quotes, digits that read back.

#include "pcl_bv/report/csv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "csv_shape.h"

namespace pcl_bv::detail {
namespace {

const std::string columns = "cluster,points,method,cx,cy,cz,sx,sy,sz,qx,qy,qz,qw,radius,volume";
const std::string not_upright = ",,,,\n";

Report report_of(const std::string& file, std::vector<ClusterEntry> clusters) {
  Report report;
  report.file = file;
  report.clusters = std::move(clusters);
  return report;
}

std::string line_of(const std::string& method, const AnyVolume& volume) {
  std::string text;
  append_csv("f", {3, 12, {{method, volume, {}}}}, text);
  return text;
}

TEST(Csv, ColumnsAreTheDocumentedOnes) {
  EXPECT_EQ(kCsvColumns, columns);
  EXPECT_EQ(report_csv_heading(), "file," + columns + ",length,width,height,yaw\n");
  EXPECT_EQ(frames_csv_heading(),
            "seq,stamp_ns,track," + columns + ",vx,vy,vz,x,y,z,yaw,length,width,height,box_yaw\n");
}

TEST(Csv, BoxHasCentreSizeAndVolume) {
  EXPECT_EQ(line_of("aabb", Aabb({0, -1, 0.5}, {1, 2, 3})),
            "f,3,12,aabb,0.5,0.5,1.75,1,3,2.5,,,,,,7.5" + not_upright);
}

TEST(Csv, SphereHasCentreRadiusAndVolume) {
  std::string line = line_of("sphere-exact", Sphere({1, 2, -0.0}, 0.5));
  ASSERT_EQ(line.substr(line.size() - not_upright.size()), not_upright);
  line.resize(line.size() - not_upright.size());
  EXPECT_EQ(line.substr(0, line.rfind(',')), "f,3,12,sphere-exact,1,2,0,,,,,,,,0.5");
  EXPECT_EQ(std::strtod(line.c_str() + line.rfind(',') + 1, nullptr), Sphere({1, 2, 0}, 0.5).volume());
}

TEST(Csv, KdopHasCentreOfMassAndSizeOfItsBox) {
  SlabVector min(3), max(3);
  min << 0, 0, 0;
  max << 1, 2, 4;
  const Kdop kdop(KdopSet::dop6(), min, max);
  double x = 0, y = 0, z = 0, volume = 0;
  const std::string line = line_of("dop6", kdop);
  ASSERT_EQ(std::sscanf(line.c_str(), "f,3,12,dop6,%lf,%lf,%lf,1,2,4,,,,,,%lf,,,,\n", &x, &y, &z, &volume), 4)
      << line;
  EXPECT_EQ(Eigen::Vector3d(x, y, z), kdop.center());
  EXPECT_EQ(volume, kdop.volume());
}

TEST(Csv, EmptyVolumeHasNoNumbers) {
  for (const AnyVolume& volume : {AnyVolume(Aabb()), AnyVolume(Sphere()), AnyVolume(Kdop())})
    EXPECT_EQ(line_of("m", volume), "f,3,12,m,,,,,,,,,,,," + not_upright);
}

TEST(Csv, AFitThatFailedHasNoNumbers) {
  std::string text;
  append_csv("f", {3, 12, {{"hull", Hull(), {}, "gave up"}}}, text);
  EXPECT_EQ(text, "f,3,12,hull,,,,,,,,,,,," + not_upright);
}

// A pole of 6 m, longer along y: sz is its height, and its yaw that of the longer side of its base.
const Obb pole =
    Obb({1, 2, 3}, Eigen::Matrix3d::Identity(), {0.25, 0.5, 3}).upright(Eigen::Vector3d::UnitZ());

TEST(Csv, UprightBoxesHaveLengthWidthHeightAndYawInTheLastColumns) {
  for (const char* method : {"obb-yaw", "obb-lshape"}) {
    const std::string line = line_of(method, pole);
    EXPECT_NE(line.find(",1,2,3,1,0.5,6,"), std::string::npos) << "sz is the height: " << line;
    const std::string last = ",1,0.5,6,1.5707963267948966\n";
    EXPECT_EQ(line.substr(line.size() - last.size()), last) << line;
  }
}

TEST(Csv, BoxesOfOtherMethodsLeaveTheColumnsOfUprightOnesEmpty) {
  for (const char* method : {"obb-pca", "obb-dito14", "obb-min", "best"}) {
    const std::string line = line_of(method, pole);
    EXPECT_EQ(line.substr(line.size() - not_upright.size()), not_upright) << line;
  }
  EXPECT_EQ(line_of("obb-yaw", Obb()), "f,3,12,obb-yaw,,,,,,,,,,,," + not_upright);
}

TEST(Csv, OfATrackTheLastColumnsComeAfterThoseOfTheTrack) {
  ClusterEntry cluster{3, 12, {{"obb-yaw", pole, {}}, {"aabb", Aabb({0, 0, 0}, {1, 1, 1}), {}}}};
  cluster.track.emplace();
  cluster.track->pose = {7, 8, 9, -0.5};
  std::string text;
  append_csv("0,0,0", cluster, text, true);
  EXPECT_NE(text.find(",0,0,0,7,8,9,-0.5,1,0.5,6,1.5707963267948966\n"), std::string::npos) << text;
  EXPECT_NE(text.find(",0,0,0,7,8,9,-0.5,,,,\n"), std::string::npos) << text;
}

TEST(Csv, EveryLineHasAsManyFieldsAsTheHeading) {
  for (const AnyVolume& volume : {AnyVolume(Aabb()), AnyVolume(Aabb({0, 0, 0}, {1, 1, 1})),
                                  AnyVolume(Sphere({0, 0, 0}, 1)), AnyVolume(Sphere())}) {
    const std::string line = line_of("m", volume), heading = report_csv_heading();
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(heading.begin(), heading.end(), ','));
  }
}

TEST(Csv, FieldsAreQuotedWhereTheyMustBe) {
  EXPECT_EQ(csv_field("a b.pcd"), "a b.pcd");
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("say \"hi\""), "\"say \"\"hi\"\"\"");
  EXPECT_EQ(csv_field("\""), "\"\"\"\"");
  EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csv_field("cr\r"), "\"cr\r\"");
  EXPECT_EQ(csv_field("\xff"), "\xff");
}

TEST(Csv, ReportHasALineForEachVolumeOfEachCluster) {
  const Aabb box({0, 0, 0}, {1, 1, 1});
  const Report report = report_of(
      "a,b.pcd", {{0, 9, {{"aabb", box, {}}, {"sphere-ritter", Sphere(), 1}}}, {1, 4, {{"aabb", box, {}}}}});
  EXPECT_EQ(report_csv(report),
            "\"a,b.pcd\",0,9,aabb,0.5,0.5,0.5,1,1,1,,,,,,1,,,,\n"
            "\"a,b.pcd\",0,9,sphere-ritter,,,,,,,,,,,,,,,,\n"
            "\"a,b.pcd\",1,4,aabb,0.5,0.5,0.5,1,1,1,,,,,,1,,,,\n");
}

TEST(Csv, FailedReportHasNoLines) {
  Report report = report_of("a.pcd", {{0, 9, {{"aabb", Aabb(), {}}}}});
  report.error = "gone";
  EXPECT_EQ(report_csv(report), "");
}

TEST(Csv, FirstColumnsAreTheCallers) {
  std::string text = "before\n";
  append_csv("0,1500,", {2, 1, {{"aabb", Aabb(), {}}}}, text);
  EXPECT_EQ(text, "before\n0,1500,,2,1,aabb,,,,,,,,,,,," + not_upright);
}

TEST(Csv, NumbersReadBackExactly) {
  const double odd = 0.1 + 0.2, tiny = std::numeric_limits<double>::denorm_min();
  const std::string line = line_of("s", Sphere({odd, -1e300, tiny}, 0));
  EXPECT_EQ(line, "f,3,12,s,0.30000000000000004,-1e+300,5e-324,,,,,,,,0,0" + not_upright);
}

TEST(Csv, NumberThatIsNotFiniteIsAnError) {
  EXPECT_THROW(line_of("aabb", Aabb({-1e308, 0, 0}, {1e308, 1, 1})), std::domain_error);
}

// Shapes as other volumes have them.
struct Box {
  Eigen::Vector3d half_extents() const { return {1, 2, 3}; }
  Eigen::Quaterniond quaternion() const { return {0.5, 0.5, 0.5, 0.5}; }
};
struct Egg {
  Eigen::Vector3d radii() const { return {1, 2, 3}; }
  Eigen::Matrix3d axes() const { return Eigen::Vector3d(1, 1, hand).asDiagonal(); }
  double hand = 1;
};
struct Can {
  Eigen::Vector3d axis() const { return {1, 0, 0}; }
  double half_height() const { return 4; }
  double radius() const { return 0.5; }
};
struct Pill {
  Eigen::Vector3d a() const { return {0, 0, 1}; }
  Eigen::Vector3d b() const { return end; }
  double radius() const { return 0.5; }
  Eigen::Vector3d end;
};

TEST(CsvShape, OfATurnedBoxIsSizeAndRotation) {
  const CsvShape shape = csv_shape(Box());
  EXPECT_EQ(*shape.size, Eigen::Vector3d(2, 4, 6));
  EXPECT_EQ(shape.rotation->coeffs(), Eigen::Vector4d(0.5, 0.5, 0.5, 0.5));
  EXPECT_FALSE(shape.radius);
}

TEST(CsvShape, OfAnEllipsoidIsARotationWhicheverHandItsAxesAreOf) {
  for (const double hand : {1.0, -1.0}) {
    const CsvShape shape = csv_shape(Egg{hand});
    EXPECT_EQ(*shape.size, Eigen::Vector3d(2, 4, 6));
    EXPECT_EQ(shape.rotation->coeffs(), Eigen::Vector4d(0, 0, 0, 1));
  }
}

TEST(CsvShape, OfRoundShapesTurnsZToTheAxis) {
  const CsvShape can = csv_shape(Can());
  EXPECT_EQ(*can.size, Eigen::Vector3d(1, 1, 8));
  EXPECT_EQ(*can.radius, 0.5);
  EXPECT_TRUE((*can.rotation * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX(), 1e-15));
  const CsvShape pill = csv_shape(Pill{{0, 3, 1}});
  EXPECT_EQ(*pill.size, Eigen::Vector3d(1, 1, 4));
  EXPECT_TRUE((*pill.rotation * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitY(), 1e-15));
  EXPECT_EQ(csv_shape(Pill{{0, 0, 1}}).rotation->coeffs(), Eigen::Vector4d(0, 0, 0, 1));
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(1e-9, 2e-9, -1), Eigen::Vector3d(3, -4, -12)}) {
    const Eigen::Vector3d turned = *round_shape(axis, 1, 2).rotation * Eigen::Vector3d::UnitZ();
    EXPECT_TRUE(turned.isApprox(-axis.normalized(), 1e-15))
        << axis.transpose() << " is turned to " << turned.transpose();
  }
}

}  // namespace
}  // namespace pcl_bv::detail
