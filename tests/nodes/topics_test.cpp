// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/topics.h"

#include <gtest/gtest.h>

#include <cstring>

#include "frames.h"
#include "pcl_bv/messages/polygon.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "stream/topics/scene.h"

namespace pcl_bv::detail {
namespace {

// Frames of a street, with every shape and tracks.
struct Street {
  Street() : xyz(street(4)) {
    config.volumes = {"sphere", "obb-lshape", "aabb", "dop26", "cylinder", "ellipsoid", "capsule", "prism"};
    config.track.enabled = true;
    config.track.birth = 2;
    pipeline.set_config(config);
  }
  void process(std::size_t number) {
    frame = third_orientation(xyz[number], number);
    pipeline.process(frame, result);
  }
  std::vector<std::vector<float>> xyz;
  PipelineConfig config;
  FramePipeline pipeline;
  Frame frame;
  FrameResult result;
};

TEST(Topics, HaveTheFootprintOfAPrismAsAPolygon) {
  Street street;
  street.process(0);
  const Prism prism(Eigen::Matrix3d::Identity(), {{0, 0}, {4, 0.5}, {0, 3}}, 1, 3);
  msg::PolygonStamped message;
  fill_footprint(street.frame, prism, message);
  EXPECT_EQ(message.header.frame_id, "lidar");
  ASSERT_EQ(message.polygon.points.size(), 3U);
  const msg::Point32& corner = message.polygon.points[1];
  EXPECT_EQ((std::array{corner.x, corner.y, corner.z}), (std::array{4.0F, 0.5F, 1.0F}));
  fill_footprint(street.frame, Prism(), message);
  EXPECT_TRUE(message.polygon.points.empty());
}

TEST(Topics, HaveADetectionForEachObjectWithItsTrack) {
  Street street;
  for (std::size_t i = 0; i < 3; ++i)
    street.process(i);
  msg::Detection3DArray array;
  fill_detections(street.frame, street.result, array);
  EXPECT_EQ(array.header.stamp.nanosec, 200'000'000U);
  EXPECT_EQ(array.header.frame_id, "lidar");
  ASSERT_EQ(array.detections.size(), street.result.clusters.size());
  std::size_t tracked = 0;
  for (std::size_t i = 0; i < array.detections.size(); ++i) {
    const msg::Detection3D& detection = array.detections[i];
    const Obb& box = std::get<Obb>(street.result.volume(i, 1));  // the first method that is a box
    EXPECT_EQ(detection.bbox.center.position.x, box.center().x());
    EXPECT_EQ(detection.bbox.size.z, 2 * box.half_extents().z());
    EXPECT_EQ(detection.bbox.center.orientation.w, box.quaternion().w());
    ASSERT_EQ(detection.results.size(), 1U);
    const bool has_track = street.result.tracks[i].has_value();
    EXPECT_EQ(detection.id, has_track ? std::to_string(street.result.tracks[i]->id) : "");
    if (!has_track) continue;
    EXPECT_EQ(detection.results[0].pose.covariance[0], street.result.tracks[i]->covariance[0]);
    ++tracked;
  }
  EXPECT_GT(tracked, 5U);
}

TEST(Topics, HaveAMarkerForEachVolumeAndDeleteWhatEnds) {
  Street street;
  ShownObjects shown;
  msg::MarkerArray array;
  std::set<std::pair<std::string, std::int32_t>> alive;
  for (std::size_t number = 0; number < 4; ++number) {
    street.process(number);
    fill_markers(street.frame, street.result, viewer_shapes(street.result), 300'000'000, shown, array);
    std::size_t added = 0;
    for (const msg::Marker& marker : array.markers) {
      const std::pair key(marker.ns, marker.id);
      if (marker.action == msg::Marker::DELETE) {
        EXPECT_EQ(alive.erase(key), 1U);
        continue;
      }
      alive.insert(key);
      ++added;
      EXPECT_EQ(marker.lifetime.nanosec, 300'000'000U);
      EXPECT_EQ(marker.type == msg::Marker::LINE_LIST, !marker.points.empty()) << marker.ns;
      EXPECT_EQ(marker.points.size() % 2, 0U);
    }
    EXPECT_EQ(added, 8 * street.result.clusters.size());
    EXPECT_EQ(alive.size(), added);  // all that is shown is of this frame
  }
}

TEST(Topics, HaveAnEntityForEachObjectAndDeleteWhatEnds) {
  Street street;
  ShownObjects shown;
  msg::SceneUpdate scene;
  std::set<std::string> alive;
  for (std::size_t number = 0; number < 4; ++number) {
    street.process(number);
    fill_scene(street.frame, street.result, viewer_shapes(street.result), 300'000'000, shown, scene);
    for (const msg::SceneEntityDeletion& deletion : scene.deletions)
      EXPECT_EQ(alive.erase(deletion.id), 1U);
    for (const msg::SceneEntity& entity : scene.entities) {
      alive.insert(entity.id);
      EXPECT_EQ(entity.cubes.size(), 2U);
      EXPECT_EQ(entity.spheres.size(), 2U);  // and the ellipsoid
      EXPECT_EQ(entity.cylinders.size(), 1U);
      EXPECT_EQ(entity.lines.size(), 3U);
      EXPECT_EQ(entity.texts.size(), 1U);
    }
    EXPECT_EQ(alive.size(), street.result.clusters.size());
  }
}

template <typename Pose>
Eigen::Vector3d third_axis(const Pose& pose) {
  const auto& q = pose.orientation;
  return Eigen::Quaterniond(q.w, q.x, q.y, q.z) * Eigen::Vector3d::UnitZ();
}

TEST(Topics, HaveUprightBoxesWhoseThirdAxisIsUp) {
  for (const char* method : {"obb-yaw", "obb-lshape"}) {
    for (const Eigen::Vector3d& up : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.1, -0.2, 2)}) {
      SCOPED_TRACE(method);
      Street street;
      street.config.volumes = {method};
      street.config.track.smooth = street.config.track.grow = true;
      street.config.ground.up = up;
      street.pipeline.set_config(street.config);
      for (std::size_t i = 0; i < 4; ++i)
        street.process(i);
      ShownObjects of_markers, of_scene;
      msg::Detection3DArray detections;
      msg::MarkerArray markers;
      msg::SceneUpdate scene;
      fill_detections(street.frame, street.result, detections);
      fill_markers(street.frame, street.result, viewer_shapes(street.result), 300'000'000, of_markers,
                   markers);
      fill_scene(street.frame, street.result, viewer_shapes(street.result), 300'000'000, of_scene, scene);
      ASSERT_GT(detections.detections.size(), 5U);
      for (const msg::Detection3D& detection : detections.detections)
        EXPECT_LE((third_axis(detection.bbox.center) - up.normalized()).norm(), 1e-15);
      for (const msg::Marker& marker : markers.markers)
        EXPECT_LE((third_axis(marker.pose) - up.normalized()).norm(), 1e-15);
      for (const msg::SceneEntity& entity : scene.entities)
        EXPECT_LE((third_axis(entity.cubes.at(0).pose) - up.normalized()).norm(), 1e-15);
    }
  }
}

TEST(Topics, HoldThePointsWithTheirLabels) {
  Street street;
  street.process(0);
  struct : msg::PointCloud2 {
    std::vector<std::uint8_t> data;  // its own, as ROS has it
  } cloud;
  fill_points(street.frame, street.result, cloud);
  const std::vector<std::uint8_t>& bytes = cloud.data;
  const std::vector<std::uint32_t> labels = labels_of(street.frame, street.result);
  ASSERT_EQ(cloud.width, street.frame.points.count);
  ASSERT_EQ(bytes.size(), std::size_t{16} * cloud.width);
  for (std::size_t i = 0; i < cloud.width; ++i) {
    EXPECT_EQ(std::memcmp(bytes.data() + 16 * i, &street.xyz[0][3 * i], 12), 0);
    EXPECT_EQ(std::memcmp(bytes.data() + 16 * i + 12, &labels[i], 4), 0);
  }
}

TEST(Topics, HoldTheIntensityOfPointsWhereItIsKnown) {
  Street street;
  street.process(0);
  std::vector<std::uint16_t> measured(street.frame.points.count);
  for (std::size_t i = 0; i < measured.size(); ++i)
    measured[i] = static_cast<std::uint16_t>(7 * i % 50'000);
  street.frame.intensity = FieldView{reinterpret_cast<const std::byte*>(measured.data()), 2, 'U', 2};
  struct : msg::PointCloud2 {
    std::vector<std::uint8_t> data;
  } cloud;
  fill_points(street.frame, street.result, cloud);
  ASSERT_EQ(cloud.fields.size(), 5U);
  EXPECT_EQ(cloud.fields[4].name, "intensity");
  ASSERT_EQ(cloud.data.size(), std::size_t{20} * cloud.width);
  const std::vector<std::uint32_t> labels = labels_of(street.frame, street.result);
  for (std::size_t i = 0; i < cloud.width; ++i) {
    float intensity = 0;
    std::memcpy(&intensity, cloud.data.data() + 20 * i + 16, 4);
    EXPECT_EQ(intensity, static_cast<float>(measured[i]));
    EXPECT_EQ(std::memcmp(cloud.data.data() + 20 * i, &street.xyz[0][3 * i], 12), 0);
    EXPECT_EQ(std::memcmp(cloud.data.data() + 20 * i + 12, &labels[i], 4), 0);
  }
}

TEST(DrawnVolumes, AreWhereTheVolumesAre) {
  const Eigen::Matrix3d axes = Eigen::Quaterniond(0.5, 0.1, -0.7, 0.3).normalized().toRotationMatrix();
  const Cylinder cylinder({1, 2, 3}, axes.col(0), 0.5, 2);
  const VolumeShape shown = viewer_shape(AnyVolume(cylinder));
  EXPECT_EQ(shown.kind, VolumeShape::Kind::cylinder);
  const Eigen::Quaterniond turn(shown.orientation[3], shown.orientation[0], shown.orientation[1],
                                shown.orientation[2]);
  EXPECT_LT((turn * Eigen::Vector3d::UnitZ() - cylinder.axis()).norm(), 1e-12);
  EXPECT_EQ(shown.size, (std::array<double, 3>{1, 1, 4}));
  EXPECT_TRUE(viewer_shape(AnyVolume(Sphere())).line_points.empty());
}

// As roscpp's messages are: time with nsec, a type for each field.
struct RosTime {
  std::uint32_t sec = 0, nsec = 0;
};
struct RosHeader {
  std::uint32_t seq = 0;
  RosTime stamp;
  std::string frame_id;
};
struct RosMarker {
  enum { CUBE = 1, SPHERE = 2, CYLINDER = 3, LINE_LIST = 5, DELETE = 2 };
  RosHeader header;
  std::string ns;
  std::int32_t id = 0, type = 0, action = 0;
  msg::Pose pose;
  msg::Vector3 scale;
  msg::ColorRGBA color;
  RosTime lifetime;
  std::vector<msg::Point> points;
};
struct RosMarkerArray {
  std::vector<RosMarker> markers;
};

TEST(Topics, FillTypesWithRos1Times) {
  Street street;
  street.process(3);
  ShownObjects shown;
  RosMarkerArray array;
  fill_markers(street.frame, street.result, viewer_shapes(street.result), 1'500'000'000, shown, array);
  ASSERT_FALSE(array.markers.empty());
  EXPECT_EQ(array.markers[0].header.stamp.nsec, 300'000'000U);
  EXPECT_EQ(array.markers[0].lifetime.sec, 1U);
}

TEST(Topics, ACylinderIsTurnedToItsAxisAlsoStraightDown) {
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(1, 0, 0),
        Eigen::Vector3d(1e-9, 2e-9, -1), Eigen::Vector3d(3, -4, -12)}) {
    const Cylinder cylinder({1, 2, 3}, axis.normalized(), 0.5, 2);
    const auto [x, y, z, w] = viewer_shape(AnyVolume(cylinder)).orientation;
    EXPECT_LT((Eigen::Quaterniond(w, x, y, z) * Eigen::Vector3d::UnitZ() - cylinder.axis()).norm(), 1e-15)
        << axis.transpose();
  }
}

}  // namespace
}  // namespace pcl_bv::detail
