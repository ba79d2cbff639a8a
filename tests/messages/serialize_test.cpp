// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/messages/serialize.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string_view>

#include "pcl_bv/messages/finite.h"
#include "pcl_bv/messages/moveit.h"
#include "pcl_bv/messages/results.h"

namespace pcl_bv::detail {
namespace {

using Buffer = std::vector<std::byte>;

template <class Message>
Buffer cdr_of(const Message& message) {
  Buffer bytes;
  write_cdr(message, bytes);
  return bytes;
}

Buffer bytes_of(std::string_view text) {
  const auto* const bytes = reinterpret_cast<const std::byte*>(text.data());
  return {bytes, bytes + text.size()};
}

// A message of every kind of field, of sizes that need every kind of padding.
msg::MarkerArray markers() {
  static const Buffer pixels = bytes_of("\1\2\3");
  msg::Marker marker;
  marker.header = {{-7, 999'999'999}, "map"};
  marker.ns = "sphere-exact";
  marker.id = -3;
  marker.type = msg::Marker::LINE_LIST;
  marker.pose = {{1, -2, 0.1}, {0, 0, 0.6, 0.8}};
  marker.scale = {0.5, 1e-300, 7};
  marker.color = {0.25F, 0.5F, 0.75F, 1};
  marker.lifetime = {3, 4};
  marker.frame_locked = true;
  marker.points = {{1, 2, 3}, {4, 5, 6}};
  marker.colors = {{1, 0, 0, 1}};
  marker.texture = {{{1, 2}, "t"}, "png", {pixels.data(), pixels.size()}};
  marker.uv_coordinates = {{0.5F, 1}};
  marker.text = "a";
  marker.mesh_file = {"f", {pixels.data(), 2}};
  return {{marker, msg::Marker()}};
}

msg::SceneUpdate scene() {
  msg::SceneEntity entity;
  entity.timestamp = {5, 6};
  entity.id = "17";
  entity.metadata = {{"points", "120"}};
  entity.cubes = {{{{1, 2, 3}, {}}, {4, 5, 6}, {0.1, 0.2, 0.3, 0.4}}};
  entity.spheres.resize(2);
  entity.cylinders = {{{}, {1, 1, 2}, 1, 0.5, {}}};
  entity.lines.resize(1);
  entity.lines[0].points = {{1, 2, 3}};
  entity.lines[0].indices = {0, 0};
  entity.texts.resize(1);
  entity.texts[0].text = "car";
  entity.arrows.resize(1);
  entity.triangles.resize(1);
  entity.models.resize(1);
  return {{{{1, 2}, msg::SceneEntityDeletion::ALL, "x"}}, {entity}};
}

msg::PlanningScene planning_scene() {
  msg::CollisionObject object;
  object.id = "bv_7";
  object.primitives = {{msg::ShapePrimitive::SPHERE, {0.5}, {}}};
  object.primitive_poses.resize(1);
  object.meshes = {{{{{0, 1, 2}}}, {{1, 2, 3}, {4, 5, 6}, {7, 8, 10}}}};
  object.mesh_poses.resize(1);
  msg::PlanningScene scene;
  scene.object_colors = {{"bv_7", {1, 0, 0, 1}}};
  scene.collision_objects = {object, msg::CollisionObject()};
  scene.is_diff = true;
  return scene;
}

template <class Message>
void expect_round_trip(const Message& message) {
  const Buffer cdr = cdr_of(message);
  Message read;
  read_cdr(cdr.data(), cdr.size(), read);
  EXPECT_EQ(cdr_of(read), cdr);
  Buffer ros1, again;
  write_ros1(message, ros1);
  read_ros1(ros1.data(), ros1.size(), read);
  write_ros1(read, again);
  EXPECT_EQ(again, ros1);
}

TEST(Messages, ReadBackAsTheyAreWritten) {
  expect_round_trip(markers());
  expect_round_trip(scene());
  expect_round_trip(msg::Detection3DArray{
      {{1, 2}, "lidar"}, {{{}, {{{"3", 0.5}, {{}, {1, 2, 3}}}}, {{}, {1, 2, 3}}, "17"}, {}}});
  expect_round_trip(msg::TFMessage{{{{{}, "map"}, "lidar", {{1, 2, 3}, {0, 0, 1, 0}}}}});
  expect_round_trip(planning_scene());
  expect_round_trip(msg::DiagnosticArray{{}, {{msg::DiagnosticStatus::WARN, "n", "m", "", {{"k", "v"}}}}});
}

// By the rules of DDSI-RTPS, by hand: each number at a multiple of its size after the encapsulation, texts
// with their null, lists after their length.
TEST(Messages, AreAlignedFromTheEndOfTheEncapsulation) {
  const msg::Header header{{1, 0x01020304}, "ab"};
  EXPECT_EQ(cdr_of(header), bytes_of(std::string_view("\0\1\0\0\1\0\0\0\4\3\2\1\3\0\0\0ab\0", 19)));
  const msg::PointField field{"x", 4, 7, 1};
  EXPECT_EQ(cdr_of(field), bytes_of(std::string_view("\0\1\0\0\2\0\0\0x\0\0\0\4\0\0\0\7\0\0\0\1\0\0\0", 24)));
}

TEST(Messages, OfRos1AreNotAlignedAndHaveASequenceNumber) {
  Buffer bytes;
  write_ros1(msg::Header{{1, 2}, "ab"}, bytes);
  EXPECT_EQ(bytes, bytes_of(std::string_view("\0\0\0\0\1\0\0\0\2\0\0\0\2\0\0\0ab", 18)));
  bytes.clear();
  write_ros1(msg::PointField{"x", 4, 7, 1}, bytes);
  EXPECT_EQ(bytes, bytes_of(std::string_view("\1\0\0\0x\4\0\0\0\7\1\0\0\0", 14)));
}

TEST(Messages, InBigEndianAreRead) {
  const Buffer bytes = bytes_of(std::string_view("\0\0\0\0\0\0\0\1\1\2\3\4\0\0\0\3ab\0", 19));
  msg::Header header;
  read_cdr(bytes.data(), bytes.size(), header);
  EXPECT_EQ(header.stamp.sec, 1);
  EXPECT_EQ(header.stamp.nanosec, 0x01020304U);
  EXPECT_EQ(header.frame_id, "ab");
}

TEST(Messages, AreFiniteIfEachOfTheirNumbersIs) {
  EXPECT_TRUE(is_finite(planning_scene()));
  EXPECT_TRUE(is_finite(markers()));
  for (const double bad :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    msg::PlanningScene scene = planning_scene();
    scene.collision_objects[0].meshes[0].vertices[2].z = bad;
    EXPECT_FALSE(is_finite(scene));
    msg::PoseWithCovariance pose;
    pose.covariance[35] = bad;
    EXPECT_FALSE(is_finite(pose));
  }
}

template <class Message>
std::string error_of(const Buffer& bytes) {
  try {
    Message message;
    read_cdr(bytes.data(), bytes.size(), message);
  } catch (const MessageError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Messages, CutAnywhereAreRefused) {
  const Buffer whole = cdr_of(markers());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Buffer part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_NE(error_of<msg::MarkerArray>(part), "no error") << size << " of " << whole.size();
  }
}

TEST(Messages, WithMoreThanTheirFieldsAreOfAnotherVersion) {
  Buffer bytes = cdr_of(msg::Header{{1, 2}, "ab"});
  bytes.resize(bytes.size() + 7);
  EXPECT_EQ(error_of<msg::Header>(bytes), "no error");  // padding
  bytes.resize(bytes.size() + 1);
  EXPECT_EQ(error_of<msg::Header>(bytes),
            "8 extra bytes after the last field: the message has another version of its type");
}

TEST(Messages, OfAnotherEncapsulationAreRefused) {
  EXPECT_EQ(error_of<msg::Header>(bytes_of(std::string_view("\0\7\0\0", 4))),
            "the encapsulation is 7, not 0 or 1 of plain CDR");
  EXPECT_EQ(error_of<msg::Header>(bytes_of("a")), "the message has no encapsulation: it has 1 bytes");
}

TEST(Messages, AnnouncedLongerThanTheyAreTakeNoMemory) {
  EXPECT_THAT(error_of<msg::MarkerArray>(bytes_of(std::string_view("\0\1\0\0\xFF\xFF\xFF\xFF", 8))),
              testing::HasSubstr("ends within a field"));
  EXPECT_THAT(error_of<msg::CompressedImage>(bytes_of(std::string_view(
                  "\0\1\0\0\0\0\0\0\0\0\0\0\1\0\0\0\0\0\0\0\1\0\0\0\0\0\0\0\xFF\xFF\xFF\xFF", 32))),
              testing::HasSubstr("ends within a field"));
}

TEST(MessageTimes, AreThoseOfNanoseconds) {
  for (const std::int64_t t : {0L, 1L, -1L, 1'500'000'000'123'456'789L, -2'147'483'648'000'000'000L}) {
    EXPECT_EQ(msg::nanoseconds_of(msg::time_of(t)), t);
    EXPECT_LT(msg::time_of(t).nanosec, 1'000'000'000U);
  }
  EXPECT_EQ(msg::time_of(std::numeric_limits<std::int64_t>::max()).sec, 2'147'483'647);
  EXPECT_EQ(msg::time_of(std::numeric_limits<std::int64_t>::min()).sec, -2'147'483'648);
}

}  // namespace
}  // namespace pcl_bv::detail
