// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/box_labels.h"
#include "volume_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>

namespace pcl_bv::detail {
namespace {

using testing::HasSubstr;

constexpr BoxLabelFormat kFormats[] = {BoxLabelFormat::kitti, BoxLabelFormat::kitti_tracking,
                                       BoxLabelFormat::nuscenes, BoxLabelFormat::openlabel,
                                       BoxLabelFormat::sustech};

ClusterEntry cluster_with(std::size_t id, const char* method, const AnyVolume& volume) {
  ClusterEntry cluster;
  cluster.id = id;
  cluster.points = 7;
  cluster.volumes.push_back({method, volume, {}});
  return cluster;
}

Eigen::Matrix3d about(const Eigen::Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}
const Eigen::Vector3d kX = Eigen::Vector3d::UnitX(), kY = Eigen::Vector3d::UnitY(),
                      kZ = Eigen::Vector3d::UnitZ();

std::string file_of(const std::vector<ClusterEntry>& clusters, BoxLabelFormat format,
                    const BoxLabelOptions& options = {}) {
  Report report;
  report.file = "a\"b.pcd";
  std::string text;
  write_box_labels(report, vector_source(clusters), format, options,
                   [&](std::string& piece) { text += piece; });
  const BoxLabelFile around = box_label_file(format);
  return std::string(around.begin) + text + std::string(around.end);
}

class BoxLabels : public VolumeFileTest {};

TEST_F(BoxLabels, OfEveryFormatReadBackAsTheSameBoxes) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const BoxLabelFormat format : kFormats) {
    const bool yaw_only = format == BoxLabelFormat::kitti || format == BoxLabelFormat::kitti_tracking;
    std::vector<ClusterEntry> clusters;
    for (std::size_t id = 0; id < 500; ++id) {
      const auto vector = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
      Eigen::Matrix3d axes = about(kZ, 3 * normal(random));
      if (!yaw_only) axes = about(kX, normal(random)) * about(kY, 2 * normal(random)) * axes;
      const Obb box(100 * vector(), axes, vector().cwiseAbs());
      clusters.push_back(cluster_with(id, yaw_only ? "obb-lshape" : "obb-min", box));
    }
    // With a frame, the keys of OpenLABEL's objects have the order of the clusters.
    const std::vector<AnyVolume> found = read(file_of(clusters, format, {{}, 0}));
    ASSERT_EQ(found.size(), clusters.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      const auto& box = std::get<Obb>(found[i]);
      const auto& written = std::get<Obb>(clusters[i].volumes[0].volume);
      EXPECT_EQ(box.half_extents(), written.half_extents()) << i;
      EXPECT_EQ(box.center().head<2>(), written.center().head<2>()) << i;
      EXPECT_NEAR(box.center().z(), written.center().z(), yaw_only ? 1e-13 : 0) << i;
      EXPECT_LT((box.axes() - written.axes()).cwiseAbs().maxCoeff(), 2e-15) << i;
    }
  }
}

TEST_F(BoxLabels, HaveTheAxesAndAnglesOfEachFormat) {
  // Three metres long, along y (left); one wide; two high; 10 in front, 2 to the left, standing at -2.
  const Obb box({10, 2, -1}, about(kZ, M_PI / 2), {1.5, 0.5, 1});
  const std::vector<ClusterEntry> one{cluster_with(4, "obb-yaw", box)};
  std::istringstream kitti(file_of(one, BoxLabelFormat::kitti, {"Car", {}}));
  std::string type;
  double truncated, occluded, alpha, skipped, h, w, l, x, y, z, rotation;
  kitti >> type >> truncated >> occluded >> alpha >> skipped >> skipped >> skipped >> skipped;
  kitti >> h >> w >> l >> x >> y >> z >> rotation;
  EXPECT_EQ(type, "Car");
  EXPECT_EQ(std::vector({h, w, l, x, y, z}), std::vector({2.0, 1.0, 3.0, -2.0, 2.0, 10.0}));
  EXPECT_NEAR(std::abs(rotation), M_PI, 1e-15);  // towards -x of the camera
  EXPECT_NEAR(std::abs(alpha - rotation - std::atan2(2, 10)), 0, 1e-15);
  EXPECT_THAT(file_of(one, BoxLabelFormat::nuscenes),
              HasSubstr(R"("translation":[10,2,-1],"size":[1,3,2],"rotation":[0.707106781186547)"));
  EXPECT_THAT(file_of(one, BoxLabelFormat::openlabel),
              HasSubstr(R"("4":{"name":"object 4","type":"unknown",)"));
  EXPECT_THAT(file_of(one, BoxLabelFormat::openlabel), HasSubstr(R"("val":[10,2,-1,0,0,0.707106781186547)"));
  EXPECT_THAT(file_of(one, BoxLabelFormat::sustech),
              HasSubstr(R"("scale":{"x":3,"y":1,"z":2},"rotation":{"x":0,"y":0,"z":1.570796326794896)"));
  const auto tilted = read(R"([{"psr":{"position":{"x":0,"y":0,"z":0},"scale":{"x":1,"y":1,"z":1},)"
                           R"("rotation":{"x":0.3,"y":0.2,"z":0.1}},"obj_type":"Car","obj_id":""}])");
  const Eigen::Matrix3d expected = about(kX, 0.3) * about(kY, 0.2) * about(kZ, 0.1);
  EXPECT_LT((std::get<Obb>(tilted[0]).axes() - expected).norm(), 1e-15);
  const auto nine = read(R"({"openlabel":{"frames":{"0":{"objects":{"1":{"object_data":{"cuboid":[)"
                         R"({"name":"b","val":[1,2,3,0.3,0.2,0.1,4,5,6]}]}}}}}}})");
  const auto& cuboid = std::get<Obb>(nine[0]);
  EXPECT_LT((cuboid.axes() - about(kZ, 0.1) * about(kY, 0.2) * about(kX, 0.3)).norm(), 1e-15);
  EXPECT_EQ(cuboid.half_extents(), Eigen::Vector3d(2, 2.5, 3));
}

TEST_F(BoxLabels, AreOfTheBestBoxThatAClusterHas) {
  const Aabb aligned({0, 0, 0}, {2, 4, 6});
  const Obb tilted({1, 1, 1}, about(kX, 0.5), {1, 2, 3}), upright({5, 5, 5}, about(kZ, 0.5), {1, 2, 3});
  ClusterEntry cluster = cluster_with(0, "sphere-exact", Sphere({0, 0, 0}, 1));
  EXPECT_EQ(file_of({cluster}, BoxLabelFormat::kitti), "");
  cluster.volumes.push_back({"aabb", aligned, {}});
  cluster.volumes.push_back({"obb-min", tilted, {}});
  EXPECT_TRUE(read(file_of({cluster}, BoxLabelFormat::sustech))[0] != AnyVolume(Obb(aligned)));
  EXPECT_EQ(center(read(file_of({cluster}, BoxLabelFormat::kitti))[0]), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(center(read(file_of({cluster}, BoxLabelFormat::openlabel))[0]), Eigen::Vector3d(1, 1, 1));
  cluster.volumes.push_back({"obb-yaw", upright, {}});
  for (const BoxLabelFormat format : kFormats)
    EXPECT_EQ(center(read(file_of({cluster}, format))[0]), Eigen::Vector3d(5, 5, 5));
}

TEST_F(BoxLabels, HaveTypesTracksAndFrames) {
  ClusterEntry cluster = cluster_with(3, "aabb", Aabb({0, 0, 0}, {1, 1, 1}));
  cluster.class_value = 12;
  EXPECT_THAT(file_of({cluster}, BoxLabelFormat::kitti_tracking, {{}, 8}),
              testing::StartsWith("8 -1 12 -1 -1 "));
  cluster.track.emplace().id = 40;
  cluster.track->velocity = {1, -2, 0};
  EXPECT_THAT(file_of({cluster}, BoxLabelFormat::kitti_tracking, {"Van", 8}),
              testing::StartsWith("8 40 Van "));
  EXPECT_THAT(file_of({cluster}, BoxLabelFormat::nuscenes),
              HasSubstr(R"("a\"b.pcd":[{"sample_token":"a\"b.pcd",)"));
  EXPECT_THAT(file_of({cluster}, BoxLabelFormat::nuscenes),
              HasSubstr(R"("velocity":[1,-2],"detection_name":"12",)"));
  EXPECT_THAT(file_of({cluster}, BoxLabelFormat::openlabel, {{}, 255}),
              HasSubstr(R"("000000ff-0000-8000-8000-000000000003":{"name":"object 3","type":"12",)"
                        R"("frame_intervals":[{"frame_start":255,"frame_end":255}])"));
  EXPECT_THAT(file_of({cluster}, BoxLabelFormat::sustech), HasSubstr(R"("obj_id":"40","obj_type":"12")"));
}

const std::string kCar = "Car 0 0 1.5 0 0 9 9 1.5 1.6 4 -2 1.7 20 0.1";

TEST_F(BoxLabels, OfKittiMayHaveScoresAndRegionsThatNobodyLabelled) {
  EXPECT_EQ(read(kCar + "\r\n\r\n" + kCar + " 0.93\n").size(), 2U);
  EXPECT_EQ(read("0 -1 DontCare -1 -1 -10 1 2 3 4 -1000 -1000 -1000 -10 -1 -1 -1\n0 2 " + kCar).size(), 1U);
  EXPECT_THAT(error_of("DontCare -1 -1 -10 1 2 3 4 -1 -1 -1 -1000 -1000 -1000 -10\n"),
              HasSubstr("no volumes"));
  const auto box = std::get<Obb>(read(kCar)[0]);
  EXPECT_LT((box.center() - Eigen::Vector3d(20, 2, -0.95)).norm(), 1e-15);
  EXPECT_EQ(box.half_extents(), Eigen::Vector3d(2, 0.8, 0.75));
}

TEST_F(BoxLabels, OfRegionsThatNobodyLabelledAreLeftOutInEveryFormat) {
  const std::string none = R"({"name":"b","val":[-10,499,-1,0,-1,0,-1000,-1000,-1000]})",
                    car = R"({"name":"b","val":[10,5,0,0,0,0.5,4,2,1.5]})";
  const auto object = [](const std::string& cuboid, const std::string& type = "") {
    return "{" + (type.empty() ? "" : R"("type":")" + type + R"(",)") + R"("object_data":{"cuboid":[)" +
           cuboid + "]}}";
  };
  const std::string types =
      R"("objects":{"0":{"name":"a","type":"DontCare"},"1":{"name":"b","type":"Car"}},)";
  for (const std::string& text : {R"({"openlabel":{)" + types + R"("frames":{"0":{"objects":{"0":)" +
                                      object(none) + R"(,"1":)" + object(car) + "}}}}}",
                                  R"({"openlabel":{"frames":{"0":{"objects":{"0":)" +
                                      object(none, "DontCare") + R"(,"1":)" + object(car) + "}}}}}",
                                  R"({"openlabel":{"objects":{"0":)" + object(none, "Dont_Care") +
                                      R"(,"1":)" + object(car, "Car") + "}}}"}) {
    const std::vector<AnyVolume> found = read(text);
    ASSERT_EQ(found.size(), 1U) << text;
    const auto& box = std::get<Obb>(found[0]);
    EXPECT_EQ(box.center(), Eigen::Vector3d(10, 5, 0));
    EXPECT_EQ(box.half_extents(), Eigen::Vector3d(2, 1, 0.75));
    EXPECT_LT((box.axes() - about(kZ, 0.5)).norm(), 1e-15);
  }
  EXPECT_THAT(error_of(R"({"openlabel":{"objects":{"0":)" + object(none, "Car") + "}}}"),
              HasSubstr("the size"));
  const std::string nuscenes = R"({"translation":[1,2,3],"size":[1,2,3],"rotation":[1,0,0,0]})",
                    sustech = R"({"psr":{"position":{"x":0,"y":0,"z":0},"scale":{"x":1,"y":1,"z":1},)"
                              R"("rotation":{"x":0,"y":0,"z":0}}})";
  for (const char* key : {"detection_name", "tracking_name", "category_name"})
    EXPECT_EQ(
        read("[" + nuscenes + R"(,{"translation":[-1000,0,0],"size":[-1,-1,-1],"rotation":[0,0,0,0],")" +
             key + R"(":"DontCare"}])")
            .size(),
        1U)
        << key;
  EXPECT_EQ(read("[" + sustech + R"(,{"psr":{"scale":{"x":-1}},"obj_type":"DontCare"}])").size(), 1U);
}

TEST_F(BoxLabels, OfSeveralCoordinateSystemsAreRefused) {
  const auto labels = [](const char* first, const char* second) {
    const auto cuboid = [](const std::string& system) {
      return R"({"val":[1,2,3,0,0,0,4,5,6],"coordinate_system":")" + system + R"("})";
    };
    return R"({"openlabel":{"objects":{"0":{"object_data":{"cuboid":[)" + cuboid(first) + "," +
           cuboid(second) + "]}}}}}";
  };
  EXPECT_EQ(read(labels("lidar", "lidar")).size(), 2U);
  EXPECT_THAT(error_of(labels("lidar", "camera")),
              HasSubstr("the coordinate_system is 'camera', that of boxes before is 'lidar'"));
}

TEST_F(BoxLabels, ThatCannotBeReadAreRefusedByName) {
  EXPECT_THAT(error_of(kCar + "\nCar 0 0\n"), HasSubstr("line 2: 15 or 16 columns are wanted"));
  EXPECT_THAT(error_of(kCar + "\n" + "Car 0 0 1.5 0 0 9 9 1.5 1.6 4 -2 x\x01 20 0.1"),
              HasSubstr("line 2: a number is wanted, not \"x?\""));
  EXPECT_THAT(error_of("Car 0 0 1.5 0 0 9 9 1.5 -1.6 4 -2 1.7 20 0.1"), HasSubstr("line 1: the size"));
  EXPECT_THAT(error_of("Car 0 0 1.5 0 0 9 9 1.5 nan 4 -2 1.7 20 0.1"),
              HasSubstr("line 1: a number is wanted"));
  const std::string good = R"({"translation":[1,2,3],"size":[1,2,3],"rotation":[1,0,0,0]})";
  EXPECT_EQ(read("[" + good + "]").size(), 1U);
  EXPECT_EQ(read(R"({"results":{"a":[)" + good + R"(],"b":[]}})").size(), 1U);
  EXPECT_THAT(error_of("[" + good + R"(,{"translation":[1,2,3]}])"), HasSubstr("[1]: has no \"rotation\""));
  EXPECT_THAT(error_of(R"({"results":{"a":[)" + good +
                       R"(],"b":[{"translation":[1],"size":[1,2,3],"rotation":)" + R"([1,0,0,0]}]}})"),
              HasSubstr("results.b[0]: translation: three numbers are wanted"));
  EXPECT_THAT(error_of(R"([{"translation":[1,2,3],"size":[1,2,3],"rotation":[0,0,0,0]}])"),
              HasSubstr("[0]: the rotation is no quaternion of length 1"));
  EXPECT_THAT(
      error_of(R"({"openlabel":{"objects":{"0":{"object_data":{"cuboid":[{"val":null}]}}}}})"),
      HasSubstr("openlabel.objects.0.object_data.cuboid[0]: val: 9 or 10 numbers are wanted, not null"));
  EXPECT_THAT(error_of(R"({"openlabel":{"cuboid":{}}})"), HasSubstr("openlabel.cuboid: a list is wanted"));
  EXPECT_THAT(error_of(R"({"objs":[{"psr":{"position":{"x":0,"y":0}}}]})"),
              HasSubstr("objs[0]: has no \"rotation\""));
  EXPECT_THAT(error_of(R"([{"psr":{"position":{"x":0,"y":0,"z":0},"scale":{"x":1,"y":-1,"z":1},)"
                       R"("rotation":{"x":0,"y":0,"z":0}}}])"),
              HasSubstr("[0]: the size"));
  EXPECT_THAT(error_of(R"({"openlabel":{"objects":{}}})"), HasSubstr("no volumes"));
}

}  // namespace
}  // namespace pcl_bv::detail
