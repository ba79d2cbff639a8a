// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "adapter_test.h"
#include "pcl_bv/messages/vision.h"
#include "pcl_bv/nodes/topics.h"

namespace pcl_bv::test {
namespace {

using msg::BoundingBox3DArray;
using msg::LabelInfo;
using msg::PointCloud2;
using msg::Ros1Detection3D;
using msg::Ros1Detection3DArray;

const Eigen::Vector3d kCentres[] = {{5, 0, 0}, {8, 3, 0}, {9, -4, 1}};

float number_at(const PointCloud2& cloud, std::size_t point, std::size_t field) {
  float value;
  std::memcpy(&value, cloud.data.data + point * cloud.point_step + 4 * field, 4);
  return value;
}

std::uint32_t detection_at(const PointCloud2& cloud, std::size_t point) {
  std::uint32_t value;
  std::memcpy(&value, cloud.data.data + point * cloud.point_step + 12, 4);
  return value;
}

class Vision : public testing::Test {
 protected:
  void write(const std::vector<Eigen::Vector3d>& centres) {
    cubes.process(centres);
    adapter().write(cubes.frame, cubes.result);
  }
  MessageAdapter& adapter() {
    if (!adapter_) adapter_ = make_vision_adapter(sent, "/bv");
    return *adapter_;
  }
  /// Points with the classes 3 and 70000 in turns.
  void give_classes() {
    auto classes = std::make_shared<std::vector<std::int64_t>>(cubes.xyz.size() / 3);
    for (std::size_t i = 0; i < classes->size(); ++i)
      (*classes)[i] = i / 200 % 2 == 0 ? 3 : 70'000;
    cubes.frame.classes = classes;
  }

  Cubes cubes{{"aabb"}};
  Sent sent;

 private:
  std::unique_ptr<MessageAdapter> adapter_;
};

TEST_F(Vision, BoxesAreThoseOfTheDetections) {
  write({kCentres[0], kCentres[1]});
  const auto arrays = sent.take<BoundingBox3DArray>("/bv/boxes");
  ASSERT_EQ(arrays.size(), 1U);
  msg::Detection3DArray detections;
  fill_detections(cubes.frame, cubes.result, detections);
  ASSERT_EQ(arrays[0].boxes.size(), 2U);
  EXPECT_EQ(arrays[0].header.frame_id, "base");
  EXPECT_EQ(msg::nanoseconds_of(arrays[0].header.stamp), cubes.frame.header.stamp_ns);
  for (std::size_t i = 0; i < 2; ++i) {
    const msg::BoundingBox3D &found = arrays[0].boxes[i], &expected = detections.detections[i].bbox;
    EXPECT_EQ(found.center.position.x, expected.center.position.x);
    EXPECT_EQ(found.size.z, expected.size.z);
  }
}

TEST_F(Vision, PointsOfEachDetectionAreThoseOfItsCluster) {
  write({kCentres[0], kCentres[1], kCentres[2]});
  const auto clouds = sent.take<PointCloud2>("/bv/detection_points");
  ASSERT_EQ(clouds.size(), 1U);
  const PointCloud2& cloud = clouds[0];
  EXPECT_EQ(cloud.width, 600U);
  EXPECT_EQ(cloud.point_step, 16U);
  EXPECT_EQ(cloud.data.size, 9600U);
  EXPECT_EQ(cloud.fields.at(3).name, "detection");
  EXPECT_TRUE(cloud.is_dense);
  std::size_t at = 0;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::int32_t* const list = cubes.result.clusters.list(i);
    for (std::size_t k = 0; k < cubes.result.clusters.list_size(i); ++k, ++at) {
      EXPECT_EQ(detection_at(cloud, at), i);
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_EQ(number_at(cloud, at, axis), cubes.xyz[3 * static_cast<std::size_t>(list[k]) + axis]);
    }
  }
  EXPECT_EQ(at, cloud.width);
}

TEST_F(Vision, PointsHaveTheirIntensityIfItIsFinite) {
  cubes.process({kCentres[0], kCentres[1]});
  std::vector<float> measured(400);
  for (std::size_t i = 0; i < measured.size(); ++i)
    measured[i] = static_cast<float>(i);
  measured[7] = std::numeric_limits<float>::quiet_NaN();
  cubes.frame.intensity = FieldView{reinterpret_cast<const std::byte*>(measured.data()), 4, 'F', 4};
  adapter().write(cubes.frame, cubes.result);
  const PointCloud2 cloud = sent.take<PointCloud2>("/bv/detection_points").at(0);
  ASSERT_EQ(cloud.point_step, 20U);
  ASSERT_EQ(cloud.width, 400U);
  std::size_t at = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < cubes.result.clusters.list_size(i); ++k, ++at) {
      const auto point = static_cast<std::size_t>(cubes.result.clusters.list(i)[k]);
      EXPECT_EQ(number_at(cloud, at, 4), point == 7 ? 0 : measured[point]);
    }
  }
}

// Without clustering the only object has all points, also those that are not finite.
TEST_F(Vision, NumbersThatAreNotFiniteNeverLeave) {
  cubes.config.cluster.tolerance = 0;
  cubes.process({kCentres[0]});
  cubes.xyz[3] = std::numeric_limits<float>::quiet_NaN();
  cubes.xyz[7] = std::numeric_limits<float>::infinity();
  cubes.xyz[11] = -std::numeric_limits<float>::infinity();
  cubes.pipeline->process(cubes.frame, cubes.result);
  const double huge = std::numeric_limits<double>::max();
  cubes.result.volumes.at(0) = Aabb({-huge, 0, 0}, {huge, 1, 1});
  adapter().write(cubes.frame, cubes.result);
  const PointCloud2 cloud = sent.take<PointCloud2>("/bv/detection_points").at(0);
  EXPECT_EQ(cloud.width, 197U);
  for (std::size_t i = 0; i < cloud.width; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      ASSERT_TRUE(std::isfinite(number_at(cloud, i, axis)));
  const BoundingBox3DArray boxes = sent.take<BoundingBox3DArray>("/bv/boxes").at(0);
  ASSERT_EQ(boxes.boxes.size(), 1U);
  EXPECT_EQ(boxes.boxes[0].size.x, 0);
}

TEST_F(Vision, EmptyCloudHasNoBoxesAndNoPoints) {
  write({});
  EXPECT_TRUE(sent.take<BoundingBox3DArray>("/bv/boxes").at(0).boxes.empty());
  const PointCloud2 cloud = sent.take<PointCloud2>("/bv/detection_points").at(0);
  EXPECT_EQ(cloud.width, 0U);
  EXPECT_EQ(cloud.data.size, 0U);
  EXPECT_TRUE(sent.take<LabelInfo>("/bv/label_info").empty());  // points have no classes
}

TEST_F(Vision, LabelsAreSentOnceAndAgainWhenTheyChange) {
  const auto process = [&](const std::string& name) {
    cubes.config.cluster.class_field = FieldName{"label"};
    cubes.config.cluster.classes = {
        {.value = 3, .name = name}, {.value = 70'000, .name = "far"}, {.value = 5}};
    cubes.pipeline->set_config(cubes.config);
    for (int i = 0; i < 2; ++i) {
      cubes.pipeline->process(cubes.frame, cubes.result);
      adapter().write(cubes.frame, cubes.result);
    }
    return sent.take<LabelInfo>("/bv/label_info");
  };
  cubes.process({kCentres[0], kCentres[1]});
  give_classes();
  for (const char* name : {"car", "bus"}) {
    const auto infos = process(name);
    ASSERT_EQ(infos.size(), 1U);
    ASSERT_EQ(infos[0].class_map.size(), 1U);  // 70000 is no uint16, and 5 has no name
    EXPECT_EQ(infos[0].class_map[0].class_id, 3);
    EXPECT_EQ(infos[0].class_map[0].class_name, name);
    EXPECT_EQ(infos[0].header.frame_id, "base");
  }
  const auto topic = std::find_if(sent.topics.begin(), sent.topics.end(),
                                  [](const MessageTopic& t) { return t.name == "/bv/label_info"; });
  ASSERT_NE(topic, sent.topics.end());
  EXPECT_TRUE(topic->latched);
}

TEST_F(Vision, DetectionsOfRos1ContainTheirPointsAndClasses) {
  sent.ros1 = true;
  cubes.config.cluster.class_field = FieldName{"label"};
  cubes.pipeline = std::make_unique<FramePipeline>();
  cubes.process({kCentres[0], kCentres[1]});
  give_classes();
  cubes.pipeline->set_config(cubes.config);
  cubes.pipeline->process(cubes.frame, cubes.result);
  adapter().write(cubes.frame, cubes.result);
  const auto arrays = sent.take<Ros1Detection3DArray>("/bv/objects");
  ASSERT_EQ(arrays.size(), 1U);
  ASSERT_EQ(arrays[0].detections.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const Ros1Detection3D& detection = arrays[0].detections[i];
    ASSERT_EQ(detection.results.size(), 1U);
    EXPECT_EQ(detection.results[0].id, cubes.result.class_of[i]);
    EXPECT_EQ(detection.source_cloud.width, 200U);
    const Aabb& box = std::get<Aabb>(cubes.result.volume(i, 0));
    EXPECT_EQ(detection.bbox.center.position.y, box.center().y());
    for (std::size_t k = 0; k < 200; ++k) {
      EXPECT_TRUE(
          box.contains({number_at(detection.source_cloud, k, 0), number_at(detection.source_cloud, k, 1),
                        number_at(detection.source_cloud, k, 2)}));
    }
  }
  EXPECT_EQ(sent.take<BoundingBox3DArray>("/bv/boxes").at(0).boxes.size(), 2U);
  EXPECT_EQ(sent.topics.size(), 2U);
}

}  // namespace
}  // namespace pcl_bv::test
