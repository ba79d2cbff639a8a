// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stream/rig/transforms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pcl_bv/messages/odometry.h"
#include "pcl_bv/messages/serialize.h"
#include "stream/rig/mounting_pose.h"
#include "stream/rig/transform_feed.h"

namespace pcl_bv::detail {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using Vector = Eigen::Vector3d;

constexpr std::int64_t kMs = 1'000'000;

Pose at(double x, double y, double z, double yaw = 0) {
  return pose_of_angles({x, y, z}, {0, 0, yaw});
}

TEST(Transforms, JoinFixedPosesOverTheCommonParent) {
  Transforms transforms;
  transforms.add_fixed("base", "mast", at(1, 0, 2, M_PI / 2));
  transforms.add_fixed("mast", "lidar", at(0.5, 0, 0));
  transforms.add_fixed("base", "camera", at(0, 0, 1));
  const FoundTransform found = transforms.find("camera", "/lidar", 7);
  ASSERT_TRUE(found.pose) << found.problem;
  // 1 m ahead of the lidar, which looks to the left, from 0.5 m left of the mast.
  EXPECT_TRUE((*found.pose * Vector(1, 0, 0)).isApprox(Vector(1, 1.5, 1), 1e-12));
  EXPECT_TRUE((*transforms.find("lidar", "camera", 7).pose * *found.pose * Vector(1, 2, 3))
                  .isApprox(Vector(1, 2, 3)));
}

TEST(Transforms, OfAFrameToItselfAreTheIdentityWithoutAnyMessage) {
  EXPECT_TRUE(Transforms().find("base", "/base", 0).pose->isApprox(Pose::Identity()));
}

TEST(Transforms, ThatAreMissingAreAProblemAndNeverTheIdentity) {
  Transforms transforms;
  transforms.add_fixed("base", "lidar", at(1, 0, 0));
  transforms.add_fixed("odom", "other", at(1, 0, 0));
  const FoundTransform unknown = transforms.find("base", "rear", 0),
                       split = transforms.find("base", "other", 0);
  EXPECT_FALSE(unknown.pose);
  EXPECT_TRUE(unknown.pending);
  EXPECT_THAT(unknown.problem, HasSubstr("no transform names the frame rear"));
  EXPECT_FALSE(split.pose);
  EXPECT_THAT(split.problem, HasSubstr("not connected; their root frames are odom and base"));
}

TEST(Transforms, AreInterpolatedBetweenTwoTimesAndNotBeyond) {
  Transforms transforms;
  transforms.add("odom", "base", 100 * kMs, at(0, 0, 0, 0));
  transforms.add("odom", "base", 200 * kMs, at(1, 0, 0, 0.2));
  const FoundTransform middle = transforms.find("odom", "base", 150 * kMs);
  ASSERT_TRUE(middle.pose);
  EXPECT_TRUE(middle.pose->isApprox(at(0.5, 0, 0, 0.1), 1e-12));
  const FoundTransform later = transforms.find("odom", "base", 201 * kMs),
                       earlier = transforms.find("odom", "base", 99 * kMs);
  EXPECT_FALSE(later.pose);
  EXPECT_TRUE(later.pending);
  EXPECT_THAT(later.problem, HasSubstr("no pose of base in odom at 0.201 s"));
  EXPECT_FALSE(earlier.pose);
  EXPECT_FALSE(earlier.pending);
}

TEST(Transforms, AreNotInterpolatedOverAGapOfMoreThanHalfASecond) {
  Transforms transforms;
  transforms.add("odom", "base", 0, at(0, 0, 0));
  transforms.add("odom", "base", 501 * kMs, at(1, 0, 0));
  EXPECT_FALSE(transforms.find("odom", "base", 250 * kMs).pose);
  transforms.add("odom", "base", 1 * kMs, at(0, 0, 0));
  EXPECT_TRUE(transforms.find("odom", "base", 250 * kMs).pose);
}

TEST(Transforms, MayComeInAnyOrder) {
  Transforms transforms;
  for (const int ms : {300, 100, 200, 100})
    transforms.add("odom", "base", ms * kMs, at(ms, 0, 0));
  EXPECT_NEAR(transforms.find("odom", "base", 150 * kMs).pose->translation().x(), 150, 1e-9);
  EXPECT_NEAR(transforms.find("odom", "base", 250 * kMs).pose->translation().x(), 250, 1e-9);
}

TEST(Transforms, AreForgottenAfterTenSecondsAndBeginAnewWhenTimeGoesBack) {
  Transforms transforms;
  for (int i = 0; i <= 300; ++i)
    transforms.add("odom", "base", 100 * kMs * i, at(i, 0, 0));
  EXPECT_FALSE(transforms.find("odom", "base", 50 * kMs).pose);
  EXPECT_TRUE(transforms.find("odom", "base", 25'000 * kMs).pose);
  transforms.add("odom", "base", 0, at(7, 0, 0));
  EXPECT_TRUE(transforms.find("odom", "base", 0).pose);
  EXPECT_FALSE(transforms.find("odom", "base", 25'000 * kMs).pose);
}

TEST(Transforms, ThatMakeACycleOrASecondParentAreIgnoredWithAWarning) {
  Transforms transforms;
  transforms.add_fixed("a", "b", at(1, 0, 0));
  transforms.add_fixed("b", "c", at(1, 0, 0));
  transforms.add_fixed("c", "a", at(1, 0, 0));
  transforms.add_fixed("d", "c", at(5, 0, 0));
  transforms.add_fixed("d", "c", at(5, 0, 0));
  transforms.add_fixed("a", "a", at(1, 0, 0));
  transforms.add_fixed("a", "", at(1, 0, 0));
  EXPECT_NEAR(transforms.find("a", "c", 0).pose->translation().x(), 2, 1e-12);
  const std::vector<std::string> warnings = transforms.take_warnings();
  ASSERT_EQ(warnings.size(), 3U);
  EXPECT_THAT(warnings[0], HasSubstr("frame a: would form a cycle with its parent c"));
  EXPECT_THAT(warnings[1], HasSubstr("frame c: has two parents, b and d"));
  EXPECT_THAT(warnings[2], HasSubstr("without names"));
  EXPECT_THAT(transforms.take_warnings(), IsEmpty());
}

TEST(Transforms, ThatAreFinalStayAndOthersGiveAWarningIfTheyDiffer) {
  Transforms transforms;
  transforms.add_fixed("base", "a", at(1, 0, 0), true);
  transforms.add_fixed("base", "b", at(1, 0, 0), true);
  transforms.add_fixed("base", "a", at(1, 0, 0));
  transforms.add_fixed("base", "b", at(1.1, 0, 0));
  EXPECT_EQ(transforms.find("base", "b", 0).pose->translation().x(), 1);
  EXPECT_THAT(transforms.take_warnings(), testing::ElementsAre(HasSubstr("frame b: has another pose")));
}

TEST(Transforms, ThatArePreferredReplaceTheOthersOfTheirFrame) {
  const auto at_x = [](double x) { return pose_of_angles({x, 0, 0}, {0, 0, 0}); };
  for (const bool preferred_first : {false, true}) {
    Transforms transforms;
    if (preferred_first) transforms.add("odom", "base", 0, at_x(1), true);
    transforms.add("other", "base", 0, at_x(5));
    transforms.add("odom", "base", 100 * kMs, at_x(6), true);
    transforms.add("odom", "base", 50 * kMs, at_x(7));
    transforms.add("base", "wheel", 100 * kMs, at_x(1));
    const FoundTransform found = transforms.find("odom", "wheel", 100 * kMs);
    ASSERT_TRUE(found.pose) << found.problem;
    EXPECT_EQ(found.pose->translation().x(), 7);
    EXPECT_EQ(transforms.find("odom", "base", 50 * kMs).pose.has_value(), preferred_first);
  }
}

TEST(Transforms, ThatArePreferredDropNothingIfTheyAreIgnored) {
  Transforms transforms;
  transforms.add_fixed("map", "odom", Pose::Identity());
  transforms.add("odom", "base", 0, Pose::Identity());
  transforms.add("base", "base", 0, Pose::Identity(), true);  // a cycle
  transforms.add("", "base", 0, Pose::Identity(), true);
  transforms.add("base", "", 0, Pose::Identity(), true);
  transforms.add("base", "odom", 0, Pose::Identity(), true);  // fixed
  EXPECT_TRUE(transforms.find("map", "base", 0).pose);
}

TEST(Transforms, OfMoreThanTenThousandFramesAreIgnoredWithAWarning) {
  Transforms transforms;
  for (int i = 0; i < 20'000; ++i)
    transforms.add_fixed("base", "frame" + std::to_string(i), at(1, 0, 0));
  EXPECT_TRUE(transforms.find("base", "frame9000", 0).pose);
  EXPECT_FALSE(transforms.find("base", "frame19000", 0).pose);
  EXPECT_THAT(transforms.take_warnings(), testing::ElementsAre(HasSubstr("more than 10000 frames")));
}

template <typename Message>
std::vector<std::byte> bytes_of(const Message& message, bool ros1) {
  std::vector<std::byte> bytes;
  if (ros1) {
    write_ros1(message, bytes);
  } else {
    write_cdr(message, bytes);
  }
  return bytes;
}

TEST(TransformMessages, GiveTheSamePosesInBothEncodings) {
  msg::TransformStamped step;
  step.header = {msg::time_of(150 * kMs), "odom"};
  step.child_frame_id = "base";
  step.transform.translation = {1, 2, 3};
  msg::Odometry odometry;
  odometry.header = step.header;
  odometry.child_frame_id = "base";
  odometry.pose.pose.position = {1, 2, 3};
  for (const bool ros1 : {false, true}) {
    for (const bool is_odometry : {false, true}) {
      const std::vector<std::byte> bytes =
          is_odometry ? bytes_of(odometry, ros1) : bytes_of(msg::TFMessage{{step}}, ros1);
      Transforms transforms;
      EXPECT_EQ(add_transforms({bytes.data(), bytes.size(), ros1, is_odometry, false}, transforms), "");
      const FoundTransform found = transforms.find("odom", "base", 150 * kMs);
      ASSERT_TRUE(found.pose) << found.problem;
      EXPECT_EQ(found.pose->translation(), Vector(1, 2, 3));
      for (std::size_t size = 0; size < bytes.size(); ++size) {
        Transforms none;
        EXPECT_THROW(add_transforms({bytes.data(), size, ros1, is_odometry, false}, none), MessageError)
            << size;
      }
    }
  }
}

TEST(TransformMessages, WithAScaleOrNaNAreIgnoredWithAWarning) {
  msg::TransformStamped scaled, nan, good;
  for (msg::TransformStamped* step : {&scaled, &nan, &good})
    step->header.frame_id = "base";
  scaled.child_frame_id = "scaled";
  scaled.transform.rotation.w = 2;
  nan.child_frame_id = "nan";
  nan.transform.translation.x = std::numeric_limits<double>::quiet_NaN();
  good.child_frame_id = "good";
  const std::vector<std::byte> bytes = bytes_of(msg::TFMessage{{scaled, nan, good}}, false);
  Transforms transforms;
  EXPECT_THAT(add_transforms({bytes.data(), bytes.size(), false, false, true}, transforms),
              HasSubstr("from nan to base is not rigid"));
  EXPECT_FALSE(transforms.find("base", "scaled", 0).pose);
  EXPECT_FALSE(transforms.find("base", "nan", 0).pose);
  EXPECT_TRUE(transforms.find("base", "good", 0).pose);
}

TEST(MountingPose, TakesAnglesAsInUrdfOrAQuaternion) {
  const std::optional<Pose> angles = mounting_pose({1, 2, 3, 0.1, 0.2, 0.3});
  ASSERT_TRUE(angles);
  const Eigen::Quaterniond q(angles->linear());
  const std::optional<Pose> same = mounting_pose({1, 2, 3, q.x(), q.y(), q.z(), q.w()});
  ASSERT_TRUE(same);
  EXPECT_TRUE(same->isApprox(*angles, 1e-12));
  // Roll first, about x, then pitch about y, then yaw about z, all fixed axes.
  EXPECT_TRUE((mounting_pose({0, 0, 0, M_PI / 2, 0, M_PI / 2})->linear() * Vector(0, 1, 0))
                  .isApprox(Vector(0, 0, 1), 1e-12));
}

TEST(MountingPose, IsNoneForScalesAndNumbersThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(mounting_pose({1, 2, 3}));
  EXPECT_FALSE(mounting_pose({1, 2, 3, 0, 0, 0, 2}));
  EXPECT_FALSE(mounting_pose({1, 2, 3, 0, 0, 0, 0}));
  EXPECT_FALSE(mounting_pose({nan, 2, 3, 0, 0, 0}));
  EXPECT_FALSE(mounting_pose({1, 2, 3, 0, nan, 0}));
}

}  // namespace
}  // namespace pcl_bv::detail
