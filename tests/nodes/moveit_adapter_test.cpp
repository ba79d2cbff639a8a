// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "adapter_test.h"
#include "pcl_bv/messages/moveit.h"
#include "stream/topics/message_sink.h"

namespace pcl_bv::test {
namespace {

using msg::CollisionObject;
using msg::PlanningScene;
using msg::ShapePrimitive;
using testing::ElementsAre;

const Eigen::Vector3d kNear{5, 0, 0}, kFar{8, 3, 0};

class MoveIt : public testing::Test {
 protected:
  explicit MoveIt(std::vector<std::string> volumes = {"aabb"}) : cubes(std::move(volumes)) {}

  /// "+ID" for each object added and "-ID" for each removed, in order.
  std::vector<std::string> changes(const std::vector<Eigen::Vector3d>& centres) {
    cubes.process(centres);
    adapter->write(cubes.frame, cubes.result);
    return taken();
  }
  std::vector<std::string> taken() {
    std::vector<std::string> all;
    for (const PlanningScene& scene : sent.take<PlanningScene>("/bv/planning_scene"))
      for (const CollisionObject& object : scene.collision_objects)
        all.push_back((object.operation == CollisionObject::ADD ? "+" : "-") + object.id);
    return all;
  }

  Cubes cubes;
  Sent sent;
  std::unique_ptr<MessageAdapter> adapter = make_moveit_adapter(sent, "/bv");
};

TEST_F(MoveIt, SceneIsADifferenceWithTheHeaderOfTheFrame) {
  cubes.process({kNear, kFar});
  adapter->write(cubes.frame, cubes.result);
  const auto scenes = sent.take<PlanningScene>("/bv/planning_scene");
  ASSERT_EQ(scenes.size(), 1U);
  EXPECT_TRUE(scenes[0].is_diff);
  EXPECT_TRUE(scenes[0].robot_state.is_diff);  // else MoveIt drops the objects attached to the robot
  ASSERT_EQ(scenes[0].collision_objects.size(), 2U);
  ASSERT_EQ(scenes[0].object_colors.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const CollisionObject& object = scenes[0].collision_objects[i];
    const Aabb& box = std::get<Aabb>(cubes.result.volume(i, 0));
    EXPECT_EQ(object.header.frame_id, "base");
    EXPECT_EQ(msg::nanoseconds_of(object.header.stamp), cubes.frame.header.stamp_ns);
    EXPECT_EQ(object.id, "bv_" + cubes.id(i));
    EXPECT_EQ(scenes[0].object_colors[i].id, object.id);
    ASSERT_EQ(object.primitives.size(), 1U);
    ASSERT_EQ(object.primitive_poses.size(), 1U);
    EXPECT_EQ(object.primitives[0].type, ShapePrimitive::BOX);
    const Eigen::Vector3d size = box.max() - box.min();
    EXPECT_THAT(object.primitives[0].dimensions, ElementsAre(size.x(), size.y(), size.z()));
    EXPECT_EQ(object.pose.position.x, box.center().x());
    EXPECT_EQ(object.primitive_poses[0].position.x, 0);
    EXPECT_EQ(object.primitive_poses[0].orientation.w, 1);
  }
}

TEST_F(MoveIt, ObjectsOfTheirOwnTopicAreThoseOfTheScene) {
  cubes.process({kNear, kFar});
  adapter->write(cubes.frame, cubes.result);
  const auto scenes = sent.take<PlanningScene>("/bv/planning_scene");
  const auto objects = sent.take<CollisionObject>("/bv/collision_object");
  ASSERT_EQ(objects.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    std::vector<std::byte> alone, inside;
    write_cdr(objects[i], alone);
    write_cdr(scenes.at(0).collision_objects[i], inside);
    EXPECT_EQ(alone, inside);
  }
  EXPECT_GE(sent.topics.at(1).history, 1000U);
}

TEST_F(MoveIt, ObjectKeepsItsIdWhileItMoves) {
  const std::vector<std::string> first = changes({kNear});
  ASSERT_EQ(first.size(), 1U);
  for (int i = 1; i < 5; ++i)
    EXPECT_EQ(changes({kNear + Eigen::Vector3d(0.1 * i, 0, 0)}), first) << i;
}

TEST_F(MoveIt, ObjectIsRemovedWhenItsTrackEnds) {
  changes({kNear, kFar});
  const std::string near = "bv_" + cubes.id(0), far = "bv_" + cubes.id(1);
  EXPECT_THAT(changes({kNear}), ElementsAre("+" + near));  // the other track has not ended
  EXPECT_THAT(changes({kNear}), ElementsAre("+" + near));
  EXPECT_THAT(changes({kNear}), ElementsAre("+" + near, "-" + far));
  EXPECT_EQ(cubes.result.active_tracks.size(), 1U);
  EXPECT_THAT(changes({kNear}), ElementsAre("+" + near));
}

TEST_F(MoveIt, TrackThatComesBackHasItsIdAndWasNeverRemoved) {
  const std::vector<std::string> first = changes({kNear});
  EXPECT_THAT(changes({}), ElementsAre());
  EXPECT_EQ(changes({kNear}), first);
}

TEST_F(MoveIt, ObjectThatComesBackAfterItsTrackEndedIsANewOne) {
  const std::vector<std::string> first = changes({kNear});
  std::vector<std::string> removed;
  for (int i = 0; i < 3; ++i)
    removed = changes({});
  EXPECT_THAT(removed, ElementsAre("-" + first.at(0).substr(1)));
  const std::vector<std::string> again = changes({kNear});
  ASSERT_EQ(again.size(), 1U);
  EXPECT_NE(again, first);
}

TEST_F(MoveIt, EmptyCloudsSendNothing) {
  EXPECT_THAT(changes({}), ElementsAre());
  EXPECT_THAT(changes({}), ElementsAre());
  EXPECT_TRUE(sent.stamps.empty());
}

TEST_F(MoveIt, ObjectsWithoutTracksLastOneFrame) {
  cubes.config.track.enabled = false;
  EXPECT_THAT(changes({kNear, kFar}), ElementsAre("+bv_cluster_0", "+bv_cluster_1"));
  EXPECT_THAT(changes({kNear}), ElementsAre("+bv_cluster_0", "-bv_cluster_1"));
}

TEST_F(MoveIt, EndOfTheStreamRemovesAll) {
  const std::vector<std::string> all = changes({kNear, kFar});
  adapter->close();
  EXPECT_THAT(taken(), ElementsAre("-" + all.at(0).substr(1), "-" + all.at(1).substr(1)));
  EXPECT_EQ(sent.stamps.back(), cubes.frame.header.stamp_ns);
  adapter->close();
  EXPECT_TRUE(taken().empty());
}

TEST_F(MoveIt, NumbersThatAreNotFiniteNeverLeave) {
  cubes.process({kNear, kFar});
  const double huge = std::numeric_limits<double>::max();
  cubes.result.volumes[0] = Aabb({-huge, 0, 0}, {huge, 1, 1});  // its size overflows
  adapter->write(cubes.frame, cubes.result);
  EXPECT_THAT(taken(), ElementsAre("+bv_" + cubes.id(1)));
}

TEST_F(MoveIt, WithoutSubscribersNothingIsMadeAndWhatEndedIsRemovedLater) {
  const std::vector<std::string> first = changes({kNear});
  sent.silent = {"/bv/planning_scene", "/bv/collision_object"};
  const std::size_t messages = sent.stamps.size();
  for (int i = 0; i < 3; ++i)
    changes({});
  EXPECT_EQ(sent.stamps.size(), messages);
  sent.silent = {};
  EXPECT_THAT(changes({}), ElementsAre("-" + first.at(0).substr(1)));
}

Eigen::Vector3d in_frame_of(const msg::Pose& pose, const Eigen::Vector3d& point) {
  const auto& q = pose.orientation;
  const auto& p = pose.position;
  return Eigen::Quaterniond(q.w, q.x, q.y, q.z).inverse() * (point - Eigen::Vector3d(p.x, p.y, p.z));
}

// How far the point is outside the shape, metres; negative inside.
double outside(const CollisionObject& object, const Eigen::Vector3d& point) {
  const Eigen::Vector3d p = in_frame_of(object.pose, point);
  if (!object.meshes.empty()) {
    double farthest = -1e9;
    const auto& [triangles, vertices] = object.meshes[0];
    for (const msg::MeshTriangle& triangle : triangles) {
      Eigen::Vector3d corners[3];
      for (std::size_t k = 0; k < 3; ++k) {
        const msg::Point& v = vertices.at(triangle.vertex_indices[k]);
        corners[k] = {v.x, v.y, v.z};
      }
      const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
      if (normal.norm() > 1e-9) farthest = std::max(farthest, normal.normalized().dot(p - corners[0]));
    }
    return farthest;
  }
  const std::vector<double>& size = object.primitives.at(0).dimensions;
  switch (object.primitives[0].type) {
    case ShapePrimitive::BOX:
      return (p.cwiseAbs() - Eigen::Vector3d(size[0], size[1], size[2]) / 2).maxCoeff();
    case ShapePrimitive::SPHERE:
      return p.norm() - size[0];
    default:
      return std::max(std::abs(p.z()) - size[0] / 2, p.head<2>().norm() - size[1]);
  }
}

TEST(MoveItShapes, ContainAllPointsWhateverTheVolume) {
  const std::map<std::string, std::uint8_t> types{{"aabb", ShapePrimitive::BOX},
                                                  {"obb-lshape", ShapePrimitive::BOX},
                                                  {"ellipsoid", ShapePrimitive::BOX},
                                                  {"sphere", ShapePrimitive::SPHERE},
                                                  {"cylinder", ShapePrimitive::CYLINDER},
                                                  {"capsule", ShapePrimitive::CYLINDER},
                                                  {"hull", 0},
                                                  {"dop26", 0},
                                                  {"prism", 0}};
  for (const auto& [volume, type] : types) {
    SCOPED_TRACE(volume);
    Cubes cubes({volume});
    Sent sent;
    const auto adapter = make_moveit_adapter(sent, "/bv");
    cubes.process({kFar});
    adapter->write(cubes.frame, cubes.result);
    const auto scenes = sent.take<PlanningScene>("/bv/planning_scene");
    ASSERT_EQ(scenes.size(), 1U);
    ASSERT_EQ(scenes[0].collision_objects.size(), 1U);
    const CollisionObject& object = scenes[0].collision_objects[0];
    ASSERT_EQ(object.primitives.size(), type == 0 ? 0U : 1U);
    ASSERT_EQ(object.meshes.size(), type == 0 ? 1U : 0U);
    ASSERT_EQ(object.mesh_poses.size(), object.meshes.size());
    if (type != 0) {
      EXPECT_EQ(object.primitives[0].type, type);
    }
    double farthest = -1e9;
    for (std::size_t i = 0; i < cubes.xyz.size(); i += 3)
      farthest = std::max(farthest, outside(object, {cubes.xyz[i], cubes.xyz[i + 1], cubes.xyz[i + 2]}));
    EXPECT_LE(farthest, 1e-12);
    EXPECT_GE(farthest, -0.2);  // and not much too large
  }
}

TEST(MoveItShapes, OfAFlatHullIsABox) {
  Cubes cubes({"hull"});
  cubes.process({kFar});
  cubes.result.volumes[0] = transformed(Prism(Eigen::Matrix3d::Identity(), {{1, 1}}, 2, 2),
                                        Eigen::Isometry3d::Identity());  // a point has no triangles
  Sent sent;
  make_moveit_adapter(sent, "")->write(cubes.frame, cubes.result);
  const auto objects = sent.take<CollisionObject>("/collision_object");
  ASSERT_EQ(objects.size(), 1U);
  ASSERT_EQ(objects[0].primitives.size(), 1U);
  EXPECT_EQ(objects[0].pose.position.z, 2);
}

// Fails to send while `fails` is true.
class FailingSender final : public MessageSender {
 public:
  FailingSender(const bool& fails, bool& closed) : fails_(fails), closed_(closed) {}
  std::size_t add_topic(const MessageTopic& /*topic*/) override { return 0; }
  void send(std::size_t, std::int64_t, const std::vector<std::byte>&) override {
    if (fails_) throw IoError("the disk is full");
  }
  void close() override { closed_ = true; }

 private:
  const bool& fails_;
  bool& closed_;
};

TEST(Adapters, ThatCannotSendTheirLastMessagesDoNotKeepTheSinkOpen) {
  bool fails = false, closed = false;
  MessageTopics topics;
  topics.adapters = {"moveit"};
  const auto sink = make_message_sink(std::make_unique<FailingSender>(fails, closed), topics);
  Cubes cubes({"aabb"});
  cubes.process({kNear});
  sink->write(cubes.frame, cubes.result);
  fails = true;
  EXPECT_THROW(sink->close(), IoError);
  EXPECT_TRUE(closed);
}

TEST(Adapters, AreNamedInTheErrorAboutAnUnknownOne) {
  EXPECT_EQ(adapter_kind("moveit").name, "moveit");
  try {
    adapter_kind("movit");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("'movit' is not moveit"));
  }
}

}  // namespace
}  // namespace pcl_bv::test
