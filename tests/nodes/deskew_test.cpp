// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Points of a sweep at one time: the motion of the sensor, and walls that become thin.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "pcl_bv/nodes/frame_pipeline.h"
#include "pipeline/deskew/deskewer.h"
#include "pipeline/deskew/sensor_motion.h"

namespace pcl_bv::detail {
namespace {

constexpr std::int64_t kStamp = 1'700'000'000'000'000'000, kStep = 100'000'000;

Pose pose_after(const SensorMotion& motion, double seconds) {
  const Eigen::Vector3d w = Eigen::Map<const Eigen::Vector3d>(motion.angular_velocity.data()) * seconds,
                        v = Eigen::Map<const Eigen::Vector3d>(motion.velocity.data()) * seconds;
  Pose pose = Pose::Identity();
  const double angle = w.norm();
  if (angle > 0) pose.linear() = Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
  constexpr int kSteps = 10000;  // of the numerical integral
  for (int i = 0; i < kSteps; ++i) {
    const double part = (i + 0.5) / kSteps;
    const Eigen::Vector3d shift = v / kSteps;
    pose.translation() += angle > 0 ? Eigen::AngleAxisd(part * angle, w / angle) * shift : shift;
  }
  return pose;
}

TEST(SensorMotion, BetweenTwoPosesLeadsFromOneToTheOther) {
  for (const SensorMotion& motion : {SensorMotion{{15, -1, 0.5}, {0.3, -0.2, 2}},
                                     SensorMotion{{10, 0, 0}, {}}, SensorMotion{{1, 2, 3}, {0, 0, 1e-7}}}) {
    Pose start = Pose::Identity();
    start.linear() = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    start.translation() << 100, -50, 2;
    const SensorMotion found = motion_between(start, start * pose_after(motion, 0.1), 0.1);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(found.velocity[i], motion.velocity[i], 1e-6);
      EXPECT_NEAR(found.angular_velocity[i], motion.angular_velocity[i], 1e-8);
    }
  }
}

// A street between walls at y = 8 and y = -8, closed at x = 60 and x = -60, with posts. The sensor drives at
// 12 m/s, turns by 30 degrees/s, and sweeps for 0.1 s from the stamp on.
class TurningDrive {
 public:
  const SensorMotion motion{{12, 0, 0}, {0, 0, std::numbers::pi / 6}};

  // A sweep of a sensor that moves, or stands at the pose of the stamp.
  Frame sweep(int number, bool moves) {
    auto data = std::make_shared<Data>();
    const Pose pose = pose_after(motion, 0.1 * number);
    constexpr int kColumns = 1800;
    for (int column = 0; column < kColumns; ++column) {
      const double seconds = 0.1 * column / kColumns;
      const Pose sensor = moves ? pose * pose_of(seconds) : pose;
      const double azimuth = 2 * std::numbers::pi * column / kColumns;
      for (double slope = -0.2; slope < 0.21; slope += 0.05) {
        const Eigen::Vector3d direction =
            Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), slope).normalized();
        const double range = range_along(sensor.translation(), sensor.linear() * direction);
        const Eigen::Vector3f point = (range * direction).cast<float>();
        data->xyz.insert(data->xyz.end(), {point.x(), point.y(), point.z()});
        data->times.push_back(static_cast<std::uint32_t>(1e9 * seconds));
      }
    }
    Frame frame;
    frame.header.stamp_ns = kStamp + number * kStep;
    frame.header.number = static_cast<std::uint64_t>(number);
    frame.points = PointView::of(data->xyz.data(), 3 * sizeof(float), data->times.size());
    frame.times = FieldView{reinterpret_cast<const std::byte*>(data->times.data()), 4, 'U', 4};
    frame.pose = pose;
    frame.owner = data;
    return frame;
  }

  // Root mean square of the distances from the nearest wall, of points within 40 m.
  static double thickness(const PointView& points, const Pose& pose) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < points.count; ++i) {
      const Coordinates c = load_point(points, i);
      const Eigen::Vector3d p = pose * Eigen::Vector3d(c.x, c.y, c.z);
      const double off = std::min(std::abs(std::abs(p.y()) - 8), std::abs(std::abs(p.x()) - 60));
      if (std::hypot(c.x, c.y) > 40 || off > 3) continue;
      sum += off * off;
      ++count;
    }
    return std::sqrt(sum / count);
  }

 private:
  struct Data {
    std::vector<float> xyz;
    std::vector<std::uint32_t> times;
  };

  // In closed form, for a motion in the plane.
  Pose pose_of(double seconds) const {
    const double angle = motion.angular_velocity[2] * seconds,
                 radius = motion.velocity[0] / motion.angular_velocity[2];
    Pose pose = Pose::Identity();
    pose.linear() = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    pose.translation() << radius * std::sin(angle), radius * (1 - std::cos(angle)), 0;
    return pose;
  }

  static double range_along(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
    double range = 200;
    const auto hit = [&](double distance) {
      if (distance > 0) range = std::min(range, distance);
    };
    for (const double side : {-1.0, 1.0}) {
      hit((8 * side - from.y()) / direction.y());
      hit((60 * side - from.x()) / direction.x());
    }
    return range;
  }
};

TEST(Deskew, MakesWallsAsThinAsThoseOfASensorThatStands) {
  TurningDrive drive;
  PipelineConfig config;
  config.volumes = {"aabb"};
  config.ground.method = GroundMethod::none;
  for (const std::size_t threads : {1, 2}) {
    config.threads = threads;
    config.deskew = Deskew::on;
    FramePipeline pipeline(config);
    FrameResult result;
    for (int i = 0; i < 4; ++i) {
      const Frame frame = drive.sweep(i, true), still = drive.sweep(i, false);
      pipeline.process(frame, result);
      if (i == 0) {
        EXPECT_EQ(result.deskew.outcome, DeskewOutcome::no_motion);
        continue;
      }
      ASSERT_EQ(result.deskew.outcome, DeskewOutcome::by_poses);
      EXPECT_EQ(deskew_warning(result), "");
      const double before = TurningDrive::thickness(frame.points, *frame.pose),
                   after = TurningDrive::thickness(result.cloud_of(frame), *frame.pose),
                   best = TurningDrive::thickness(still.points, *still.pose);
      EXPECT_GT(before, 0.2) << i;
      EXPECT_LT(after, 1e-4 + 1.1 * best) << i;
      for (std::size_t c = 0; c < result.clusters.size(); ++c) {
        const PointView points = result.points_of(c, result.cloud_of(frame));
        const auto& box = std::get<Aabb>(result.volume(c, 0));
        for (std::size_t p = 0; p < points.count; ++p) {
          const Coordinates at = load_point(points, p);
          ASSERT_TRUE(box.contains(Eigen::Vector3d(at.x, at.y, at.z)));
        }
      }
    }
  }
}

TEST(Deskew, FiltersPointsAsMeasuredAndKeepsTheirIndices) {
  TurningDrive drive;
  PipelineConfig config;
  config.volumes = {"aabb"};
  config.ground.method = GroundMethod::none;
  config.filter.range_max = 20;
  FrameResult plain, moved;
  FramePipeline as_measured(config);
  config.deskew = Deskew::automatic;
  FramePipeline deskewed(config);
  for (int i = 0; i < 2; ++i) {
    const Frame frame = drive.sweep(i, true);
    as_measured.process(frame, plain);
    deskewed.process(frame, moved);
  }
  EXPECT_FALSE(plain.deskew.moved());
  ASSERT_TRUE(moved.deskew.moved());
  EXPECT_EQ(moved.passed_filter, plain.passed_filter);
}

TEST(Deskew, SaysWhyPointsAreNotMoved) {
  TurningDrive drive;
  PipelineConfig config;
  config.volumes = {"aabb"};
  config.ground.method = GroundMethod::none;
  config.deskew = Deskew::on;
  FramePipeline pipeline(config);
  FrameResult result;
  Frame frame = drive.sweep(3, true);
  frame.times.reset();
  pipeline.process(frame, result);
  EXPECT_EQ(result.deskew.outcome, DeskewOutcome::no_times);
  EXPECT_NE(deskew_warning(result), "");
  frame = drive.sweep(4, true);
  frame.pose.reset();
  pipeline.process(frame, result);
  EXPECT_EQ(result.deskew.outcome, DeskewOutcome::no_motion);
  EXPECT_NE(deskew_warning(result), "");
  pipeline.process(drive.sweep(5, true), result);
  frame = drive.sweep(6, true);
  frame.pose->linear() = Eigen::AngleAxisd(1.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pipeline.process(frame, result);
  EXPECT_EQ(result.deskew.outcome, DeskewOutcome::too_fast);
  EXPECT_NE(deskew_warning(result), "");
  pipeline.process(drive.sweep(7, true), result);
  frame = drive.sweep(8, true);
  frame.pose->translation().x() += 300;  // the poses of another place
  pipeline.process(frame, result);
  EXPECT_EQ(result.deskew.outcome, DeskewOutcome::no_motion);
  frame.pose->translation().x() = 1e308;
  pipeline.process(drive.sweep(9, true), result);
  frame.header.stamp_ns = kStamp + 10 * kStep;
  pipeline.process(frame, result);
  EXPECT_FALSE(result.deskew.moved());
}

}  // namespace
}  // namespace pcl_bv::detail
