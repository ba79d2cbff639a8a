// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What we write is what Cyclone DDS writes of the same types, made by its own compiler from ROS's
// definitions.

#include <dds/dds.h>
#include <ros2.h>

#include <algorithm>
#include <memory>
#include <random>

#include "dds_test.h"
#include "pcl_bv/messages/livox.h"
#include "pcl_bv/messages/moveit.h"
#include "pcl_bv/messages/obstacles.h"
#include "pcl_bv/messages/polygon.h"
#include "pcl_bv/messages/results.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/messages/vision.h"
#include "stream/middleware.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

using Bytes = std::vector<std::byte>;

std::mt19937& dice() {
  static std::mt19937 engine(20261124);
  return engine;
}

// Any text, length or number; strings of every length modulo 8, so that all that follows is shifted by it.
struct Random {
  static constexpr bool ros1 = false;
  template <class... Fields>
  void operator()(Fields&... fields) {
    (set(fields), ...);
  }

 private:
  template <class T>
  void set(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      value = dice()() % 2 == 1;
    } else if constexpr (std::is_floating_point_v<T>) {
      value = static_cast<T>(dice()()) / 7;
    } else if constexpr (std::is_arithmetic_v<T>) {
      value = static_cast<T>(dice()());
    } else {
      T::each_field(value, *this);
    }
  }
  void set(std::string& text) { text.assign(dice()() % 11, static_cast<char>('a' + dice()() % 26)); }
  void set(msg::Bytes& bytes) { bytes = {kBytes, dice()() % sizeof kBytes}; }
  template <class T, std::size_t n>
  void set(std::array<T, n>& values) {
    for (T& value : values)
      set(value);
  }
  template <class T>
  void set(std::vector<T>& values) {
    values.resize(dice()() % 4);
    for (T& value : values)
      set(value);
  }

  static constexpr std::byte kBytes[40] = {std::byte{1}, std::byte{2}, std::byte{3}};
};

// Without the two bits that count the padding after the last field.
Bytes unpadded(const std::byte* data, std::size_t size) {
  Bytes bytes(data, data + size);
  bytes.resize(size - (std::to_integer<std::size_t>(bytes[3]) & 3));
  bytes[3] = std::byte{0};
  return bytes;
}

template <class Message>
class DdsTypes : public DdsTest {};

struct Cloud {
  using Message = msg::PointCloud2;
  static const dds_topic_descriptor_t& type() { return sensor_msgs_msg_dds__PointCloud2__desc; }
};
struct Markers {
  using Message = msg::MarkerArray;
  static const dds_topic_descriptor_t& type() { return visualization_msgs_msg_dds__MarkerArray__desc; }
};
struct Detections {
  using Message = msg::Detection3DArray;
  static const dds_topic_descriptor_t& type() { return vision_msgs_msg_dds__Detection3DArray__desc; }
};
struct Diagnostics {
  using Message = msg::DiagnosticArray;
  static const dds_topic_descriptor_t& type() { return diagnostic_msgs_msg_dds__DiagnosticArray__desc; }
};
struct CollisionObjects {
  using Message = msg::CollisionObject;
  static const dds_topic_descriptor_t& type() { return moveit_msgs_msg_dds__CollisionObject__desc; }
};
struct PlanningScenes {
  using Message = msg::PlanningScene;
  static const dds_topic_descriptor_t& type() { return moveit_msgs_msg_dds__PlanningScene__desc; }
};
struct Obstacles {
  using Message = msg::ObstacleArray;
  static const dds_topic_descriptor_t& type() { return nav2_dynamic_msgs_msg_dds__ObstacleArray__desc; }
};
struct Polygons {
  using Message = msg::PolygonInstanceStamped;
  static const dds_topic_descriptor_t& type() { return geometry_msgs_msg_dds__PolygonInstanceStamped__desc; }
};
struct Boxes {
  using Message = msg::BoundingBox3DArray;
  static const dds_topic_descriptor_t& type() { return vision_msgs_msg_dds__BoundingBox3DArray__desc; }
};
struct Labels {
  using Message = msg::LabelInfo;
  static const dds_topic_descriptor_t& type() { return vision_msgs_msg_dds__LabelInfo__desc; }
};
using Kinds = testing::Types<Cloud, Markers, Detections, Diagnostics, CollisionObjects, PlanningScenes,
                             Obstacles, Polygons, Boxes, Labels>;
TYPED_TEST_SUITE(DdsTypes, Kinds);

// Cyclone reads our bytes into its structures and writes those again, which we receive.
TYPED_TEST(DdsTypes, AreTheBytesThatCycloneMakesOfTheirFields) {
  const std::string type = TypeParam::Message::ros_type;
  Middleware& dds = middleware("dds");
  const auto carrier = dds.carrier("");
  const std::size_t out = carrier->add_topic({"/out", type});
  const auto back = dds.receiver("/back", {type});

  const dds_entity_t participant = dds_create_participant(own_domain(), nullptr, nullptr);
  ASSERT_GT(participant, 0);
  const std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)> qos(dds_create_qos(), dds_delete_qos);
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  const dds_entity_t reader = dds_create_reader(
      participant, dds_create_topic(participant, &TypeParam::type(), "rt/out", nullptr, nullptr), qos.get(),
      nullptr);
  const dds_entity_t writer = dds_create_writer(
      participant, dds_create_topic(participant, &TypeParam::type(), "rt/back", nullptr, nullptr), qos.get(),
      nullptr);
  ASSERT_GT(reader, 0);
  ASSERT_GT(writer, 0);
  dds_publication_matched_status_t matched{};
  ASSERT_TRUE(wait_for([&] {
    dds_get_publication_matched_status(writer, &matched);
    return carrier->has_subscribers(out) && matched.current_count > 0;
  }));

  for (int round = 0; round < 200; ++round) {
    typename TypeParam::Message message;
    Random random;
    random(message);
    Bytes sent;
    write_cdr(message, sent);
    carrier->send(out, 0, sent);
    void* sample = nullptr;
    dds_sample_info_t info;
    ASSERT_TRUE(wait_for([&] { return dds_take(reader, &sample, &info, 1, 1) > 0; })) << "round " << round;
    ASSERT_TRUE(info.valid_data);
    ASSERT_EQ(dds_write(writer, sample), DDS_RETCODE_OK);
    dds_return_loan(reader, &sample, 1);
    ReceivedMessage received;
    ASSERT_TRUE(back->next(received, std::chrono::seconds(30)));
    ASSERT_EQ(unpadded(received.data, received.size), sent) << "round " << round;
  }
  EXPECT_TRUE(carrier->take_warnings().empty());
  dds_delete(participant);
}

class DdsClouds : public DdsTest {};

// Cyclone writes the clouds of a Livox from their definition. The receiver would rather have PointCloud2.
TEST_F(DdsClouds, OfALivoxAreFoundByTheTypeOfTheirPublisher) {
  const auto receiver =
      middleware("dds").receiver("/livox", {msg::PointCloud2::ros_type, msg::CustomMsg::ros_type});
  const dds_entity_t participant = dds_create_participant(own_domain(), nullptr, nullptr);
  ASSERT_GT(participant, 0);
  const dds_entity_t writer =
      dds_create_writer(participant,
                        dds_create_topic(participant, &livox_ros_driver2_msg_dds__CustomMsg__desc, "rt/livox",
                                         nullptr, nullptr),
                        nullptr, nullptr);
  ASSERT_GT(writer, 0);
  using Point = livox_ros_driver2_msg_dds__CustomPoint_;
  std::vector<Point> points;
  for (std::uint32_t i = 0; i < 7; ++i) {
    const auto number = static_cast<float>(i);
    const auto byte = static_cast<std::uint8_t>(i);
    points.push_back({1000 * i, number, number + 0.5F, -number, byte, 16, byte});
  }
  livox_ros_driver2_msg_dds__CustomMsg_ sent{};
  sent.timebase = 1'234'567'890'123;
  std::string frame = "livox_frame";
  sent.header.frame_id = frame.data();
  sent.points._buffer = points.data();
  sent.points._length = sent.points._maximum = 7;
  ReceivedMessage received;
  ASSERT_TRUE(wait_for([&] {
    EXPECT_EQ(dds_write(writer, &sent), DDS_RETCODE_OK);
    return receiver->next(received, std::chrono::milliseconds(50));
  }));
  EXPECT_EQ(received.type, 1U);
  msg::CustomMsg message;
  read_cdr(received.data, received.size, message);
  EXPECT_EQ(message.timebase, sent.timebase);
  const auto view = view_points(message);
  ASSERT_TRUE(view);
  ASSERT_EQ(view->count, 7U);
  const auto times = view_times(message), intensity = view_intensity(message);
  ASSERT_TRUE(times && intensity);
  for (std::size_t i = 0; i < 7; ++i) {
    const auto number = static_cast<double>(i);
    const Coordinates p = load_point(*view, i);
    EXPECT_EQ(p.x, number);
    EXPECT_EQ(p.y, number + 0.5);
    EXPECT_EQ(p.z, -number);
    EXPECT_EQ(times->number(i), 1000 * number);
    EXPECT_EQ(intensity->number(i), number);
  }
  for (const std::string& warning : receiver->take_warnings())
    EXPECT_EQ(warning.find("publisher ignored"), std::string::npos) << warning;
  dds_delete(participant);
}

}  // namespace
}  // namespace pcl_bv::test
