// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Frames from several sensors, which here are lists of clouds.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <variant>

#include "pcl_bv/nodes/frame_pipeline.h"
#include "stream/rig/mounting_pose.h"
#include "stream/rig/rig_source.h"

namespace pcl_bv::detail {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using namespace std::chrono_literals;

constexpr std::int64_t kMs = 1'000'000;

struct Cloud {
  std::int64_t ms = 0;
  std::vector<float> xyz{1, 0, 0};
  std::int64_t recorded_ms = -1;
  std::vector<std::uint32_t> times_ns{};  // after the stamp
};
struct Silence {};  // a live source that has no cloud yet
struct Broken {};
using Step = std::variant<Cloud, Silence, Broken>;

// The clouds of a sensor. `live` sources do not end.
class Sensor final : public FrameSource {
 public:
  Sensor(std::string frame, std::vector<Step> steps, bool live)
      : frame_(std::move(frame)), steps_(steps.begin(), steps.end()), live_(live) {}

  Next next(Frame& frame, std::chrono::milliseconds) override {
    if (steps_.empty()) return live_ ? Next::timeout : Next::end;
    const Step step = steps_.front();
    steps_.pop_front();
    if (std::holds_alternative<Silence>(step)) return Next::timeout;
    frame = Frame();
    frame.header.frame_id = frame_;
    if (std::holds_alternative<Broken>(step)) {
      frame.header.seq = 12;
      frame.file = "sweeps/12.pcd";
      throw FrameError(frame, "cut off");
    }
    const auto cloud = std::make_shared<Cloud>(std::get<Cloud>(step));
    frame.header.stamp_ns = cloud->ms * kMs;
    if (cloud->recorded_ms >= 0) frame.recorded_ns = cloud->recorded_ms * kMs;
    frame.points = PointView::of(cloud->xyz.data(), 12, cloud->xyz.size() / 3);
    if (!cloud->times_ns.empty())
      frame.times = FieldView{reinterpret_cast<const std::byte*>(cloud->times_ns.data()), 4, 'U', 4};
    frame.owner = cloud;
    return Next::frame;
  }

  std::vector<std::string> take_warnings() override { return {}; }

 private:
  std::string frame_;
  std::deque<Step> steps_;
  bool live_;
};

RigConfig rig() {
  RigConfig config;
  config.frame = "base";
  return config;
}

ReplayOptions stamped() {
  ReplayOptions options;
  options.own_stamps = true;
  return options;
}

// Two sensors: `front` 1 m ahead, `rear` 2 m behind and turned by 180 degrees.
RigInputs two_sensors(std::vector<Step> front, std::vector<Step> rear, bool live = false) {
  RigInputs inputs;
  inputs.sensors.push_back({std::make_unique<Sensor>("front", std::move(front), live), "/front", "", {}});
  inputs.sensors.push_back({std::make_unique<Sensor>("rear", std::move(rear), live), "/rear", "", {}});
  inputs.transforms.add_fixed("base", "front", pose_of_angles({1, 0, 0}, {0, 0, 0}));
  inputs.transforms.add_fixed("base", "rear", pose_of_angles({-2, 0, 0}, {0, 0, M_PI}));
  return inputs;
}

std::vector<std::int64_t> stamps_of(const Frame& frame) {
  std::vector<std::int64_t> stamps;
  for (const SensorPart& part : frame.sensors)
    stamps.push_back(part.count == 0 ? -1 : part.stamp_ns / kMs);
  return stamps;
}

// The stamps of each sensor's clouds in all frames; -1 without a cloud. An error is an empty list.
std::vector<std::vector<std::int64_t>> frames_of(FrameSource& source, std::size_t max = 100) {
  std::vector<std::vector<std::int64_t>> all;
  Frame frame;
  while (all.size() < max) {
    try {
      if (source.next(frame, 100ms) != Next::frame) break;
      all.push_back(stamps_of(frame));
    } catch (const FrameError&) {
      all.emplace_back();
    }
  }
  return all;
}

using Stamps = std::vector<std::int64_t>;

TEST(Rig, MergesTheCloudsOfAnInstantInTheFrameOfTheRobot) {
  RigSource source(two_sensors({Cloud{0, {5, 1, 2, 6, 0, 0}}}, {Cloud{30, {3, 1, 2}}}), rig(), {});
  Frame frame;
  ASSERT_EQ(source.next(frame, 0ms), Next::frame);
  EXPECT_EQ(frame.header.frame_id, "base");
  EXPECT_EQ(frame.header.stamp_ns, 0);
  ASSERT_EQ(frame.points.count, 3U);
  const double expected[3][3] = {{6, 1, 2}, {7, 0, 0}, {-5, -1, 2}};
  for (std::size_t i = 0; i < 3; ++i) {
    const Coordinates p = load_point(frame.points, i);
    EXPECT_NEAR(p.x, expected[i][0], 1e-6);
    EXPECT_NEAR(p.y, expected[i][1], 1e-6);
    EXPECT_NEAR(p.z, expected[i][2], 1e-6);
  }
  ASSERT_EQ(frame.sensors.size(), 2U);
  EXPECT_EQ(frame.sensors[0].name, "/front");
  EXPECT_EQ(frame.sensors[1].first, 2U);
  EXPECT_EQ(frame.sensors[1].count, 1U);
  EXPECT_EQ(frame.sensors[1].stamp_ns, 30 * kMs);
  EXPECT_TRUE(frame.sensors[1].position.isApprox(Eigen::Vector3d(-2, 0, 0)));
  EXPECT_TRUE(frame.sensor->isApprox(Eigen::Vector3d(-0.5, 0, 0)));
  EXPECT_EQ(source.next(frame, 0ms), Next::end);
}

TEST(Rig, PairsCloudsOfUnequalRatesAndPhases) {
  RigSource equal(two_sensors({Cloud{0}, Cloud{100}, Cloud{200}}, {Cloud{49}, Cloud{149}, Cloud{249}}), rig(),
                  {});
  EXPECT_THAT(frames_of(equal), ElementsAre(Stamps{0, 49}, Stamps{100, 149}, Stamps{200, 249}));
  // A difference of sync_ms is too much. The next pair fits.
  RigSource late(two_sensors({Cloud{0}, Cloud{100}}, {Cloud{50}, Cloud{150}}), rig(), {});
  EXPECT_THAT(frames_of(late), ElementsAre(Stamps{0, -1}, Stamps{-1, 50}, Stamps{100, -1}, Stamps{-1, 150}));
  RigSource twice(two_sensors({Cloud{0}, Cloud{50}, Cloud{100}}, {Cloud{0}, Cloud{100}}), rig(), {});
  EXPECT_THAT(frames_of(twice), ElementsAre(Stamps{0, 0}, Stamps{50, -1}, Stamps{100, 100}));
}

TEST(Rig, GoesOnWithoutASilentSensorAndSaysSo) {
  std::vector<Step> front, rear;
  for (int i = 0; i < 8; ++i) {
    front.emplace_back(Cloud{100 * i});
    if (i < 2 || i > 6) rear.emplace_back(Cloud{100 * i});
  }
  RigSource source(two_sensors(front, rear), rig(), {});
  EXPECT_THAT(frames_of(source),
              ElementsAre(Stamps{0, 0}, Stamps{100, 100}, Stamps{200, -1}, Stamps{300, -1}, Stamps{400, -1},
                          Stamps{500, -1}, Stamps{600, -1}, Stamps{700, 700}));
  EXPECT_THAT(source.take_warnings(),
              ElementsAre(HasSubstr("/rear: no clouds for 0.300 s; the frames from 0.400 s"),
                          HasSubstr("/rear: sends clouds again, at 0.700 s")));
}

TEST(Rig, WaitsForALiveSensorNoLongerThanSyncMs) {
  RigConfig config = rig();
  config.sync_ms = 20;
  RigSource source(two_sensors({Cloud{0}}, {Silence{}, Silence{}, Cloud{5}}, true), config, stamped());
  Frame frame;
  ASSERT_EQ(source.next(frame, 1000ms), Next::frame);
  EXPECT_EQ(stamps_of(frame), (Stamps{0, 5}));

  RigSource alone(two_sensors({Cloud{0}}, {}, true), config, stamped());
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(alone.next(frame, 5000ms), Next::frame);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 20ms);
  EXPECT_EQ(stamps_of(frame), (Stamps{0, -1}));
  EXPECT_EQ(alone.next(frame, 1ms), Next::timeout);
}

TEST(Rig, DropsLateCloudsAndTimesThatRunBackwards) {
  RigSource source(two_sensors({Cloud{0}, Cloud{100}, Cloud{90}, Cloud{200}, Cloud{-5000}},
                               {Cloud{0}, Cloud{100}, Cloud{200}}),
                   rig(), {});
  EXPECT_THAT(frames_of(source), ElementsAre(Stamps{0, 0}, Stamps{100, 100}, Stamps{200, 200}));
  EXPECT_THAT(source.take_warnings(),
              ElementsAre(HasSubstr("/front: 1 late clouds dropped; the last one has the stamp 0.090 s"),
                          "/front: 2 late clouds dropped in all"));
}

TEST(Rig, BeginsAnewWhenALiveRecordingIsRepeated) {
  RigSource source(two_sensors({Silence{}, Cloud{90'000}, Cloud{90'100}, Cloud{0}, Cloud{100}},
                               {Silence{}, Cloud{90'000}, Cloud{90'100}, Cloud{0}, Cloud{100}}, true),
                   rig(), {});
  EXPECT_THAT(frames_of(source),
              ElementsAre(Stamps{90'000, 90'000}, Stamps{90'100, 90'100}, Stamps{0, 0}, Stamps{100, 100}));
}

TEST(Rig, NeverMergesCloudsOfClocksThatDiffer) {
  std::vector<Step> front, rear;
  for (int i = 0; i < 4; ++i) {
    front.emplace_back(Cloud{100 * i, {1, 0, 0}, 1000 + 100 * i});
    rear.emplace_back(Cloud{100 * i + 200, {1, 0, 0}, 3110 + 100 * i});
  }
  RigSource source(two_sensors(front, rear), rig(), stamped());
  Frame frame;
  std::size_t frames = 0, lost = 0;
  try {
    for (;;) {
      try {
        ASSERT_EQ(source.next(frame, 0ms), Next::frame);
        EXPECT_EQ(stamps_of(frame)[1], -1);
        ++frames;
      } catch (const FrameError& error) {
        EXPECT_THAT(error.what(), HasSubstr("/rear: its clock is 1.910 s behind that of /front"));
        ++lost;
      }
    }
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/rear: none of its clouds was used"));
  }
  EXPECT_EQ(frames, 4U);
  EXPECT_EQ(lost, 4U);
}

TEST(Rig, MergesCloudsOfSimulatedTimeThatRunsFaster) {
  std::vector<Step> front, rear;
  for (int i = 0; i < 30; ++i) {
    front.emplace_back(Cloud{2000 * i, {1, 0, 0}, 1000 + 100 * i});
    rear.emplace_back(Cloud{2000 * i, {1, 0, 0}, 1010 + 100 * i});
  }
  RigSource source(two_sensors(front, rear), rig(), stamped());
  EXPECT_THAT(frames_of(source), testing::SizeIs(30));
}

// One cloud of either sensor has a stamp of another time. The next frames have the clouds of both again.
TEST(Rig, LosesOnlyTheCloudWithAStampOfAnotherTime) {
  for (const std::int64_t jump : {37'000, -37'000}) {
    for (const bool in_front : {true, false}) {
      std::vector<Step> front, rear;
      for (int i = 0; i < 6; ++i) {
        front.emplace_back(
            Cloud{100'000 + 100 * i + (i == 3 && in_front ? jump : 0), {1, 0, 0}, 1000 + 100 * i});
        rear.emplace_back(
            Cloud{100'010 + 100 * i + (i == 3 && !in_front ? jump : 0), {1, 0, 0}, 1010 + 100 * i});
      }
      RigSource source(two_sensors(front, rear), rig(), stamped());
      std::size_t pairs = 0;
      for (const Stamps& stamps : frames_of(source))
        pairs += stamps.size() == 2 && stamps[0] >= 0 && stamps[1] >= 0;
      EXPECT_EQ(pairs, 5U) << jump << ' ' << in_front;
    }
  }
}

TEST(Rig, WarnsOnceOfAClockThatDiffersByLessThanASecond) {
  std::vector<Step> front, rear;
  for (int i = 0; i < 60; ++i) {
    front.emplace_back(Cloud{100 * i, {1, 0, 0}, 1000 + 100 * i});
    rear.emplace_back(Cloud{100 * i + 300, {1, 0, 0}, 1000 + 100 * i});
  }
  RigSource source(two_sensors(front, rear), rig(), stamped());
  frames_of(source);
  const std::string warning =
      "/rear: its clock is 0.300 s ahead of that of /front: clouds of the same moment get into different "
      "frames";
  EXPECT_THAT(source.take_warnings(), Contains(warning).Times(1));
}

TEST(Rig, SaysWhyTheRobotHasNoPose) {
  RigConfig config = rig();
  config.fixed_frame = "odm";
  RigSource source(two_sensors({Cloud{0}, Cloud{100}}, {Cloud{0}, Cloud{100}}), config, {});
  EXPECT_THAT(frames_of(source), testing::SizeIs(2));
  EXPECT_THAT(source.take_warnings(),
              ElementsAre("1 frames without a pose in odm: no transform names the frame odm"));
}

TEST(Rig, KnowsTheLastPositionOfASensorWithoutACloud) {
  RigSource source(two_sensors({Cloud{0}, Cloud{100}}, {Cloud{0}}), rig(), {});
  Frame frame;
  ASSERT_EQ(source.next(frame, 0ms), Next::frame);
  ASSERT_EQ(source.next(frame, 0ms), Next::frame);
  ASSERT_EQ(frame.sensors.size(), 2U);
  EXPECT_EQ(frame.sensors[1].count, 0U);
  EXPECT_EQ(frame.sensors[1].position, Eigen::Vector3d(-2, 0, 0));
}

// The clouds of a sensor in real time: one for each period, but none for a while.
class PacedSensor final : public FrameSource {
 public:
  PacedSensor(std::string frame, std::chrono::milliseconds delay, int silent_from, int silent_to)
      : frame_(std::move(frame)), delay_(delay), silent_from_(silent_from), silent_to_(silent_to) {}

  Next next(Frame& frame, std::chrono::milliseconds) override {
    const auto now = std::chrono::steady_clock::now();
    if (now < begin_ + number_ * kPeriod + delay_) return Next::timeout;
    const int number = number_++;
    if (number >= silent_from_ && number < silent_to_) return Next::timeout;
    frame = Frame();
    frame.header.frame_id = frame_;
    frame.header.stamp_ns = std::chrono::nanoseconds(number * kPeriod).count() + 1;
    frame.taken = now;
    const auto xyz = std::make_shared<std::vector<float>>(3, 1.F);
    frame.points = PointView::of(xyz->data(), 12, 1);
    frame.owner = xyz;
    return Next::frame;
  }

  static constexpr std::chrono::milliseconds kPeriod{60};

 private:
  std::string frame_;
  std::chrono::milliseconds delay_;
  int silent_from_, silent_to_, number_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

// The clouds of the second sensor come a little later than those of the first, so they must be waited for
// again.
TEST(Rig, MergesALiveSensorAgainThatWasSilent) {
  RigInputs inputs = two_sensors({}, {}, true);
  inputs.sensors[0].source = std::make_unique<PacedSensor>("front", 0ms, 0, 0);
  inputs.sensors[1].source = std::make_unique<PacedSensor>("rear", 10ms, 2, 9);
  RigConfig config = rig();
  config.sync_ms = 40;
  RigSource source(std::move(inputs), config, {});
  Frame frame;
  std::size_t with_both = 0, alone = 0;
  std::vector<std::string> warnings;
  for (int i = 0; i < 16; ++i) {
    ASSERT_EQ(source.next(frame, 1000ms), Next::frame);
    (stamps_of(frame)[1] >= 0 ? with_both : alone) += 1;
    for (std::string& line : source.take_warnings())
      warnings.push_back(std::move(line));
  }
  EXPECT_GE(with_both, 6U);
  EXPECT_GE(alone, 5U);
  EXPECT_GE(stamps_of(frame)[1], 0);
  EXPECT_THAT(warnings, Contains(HasSubstr("/rear: no clouds for 0.300 s")));
  EXPECT_THAT(warnings, Contains(HasSubstr("/rear: sends clouds again")));
}

TEST(Rig, NeverUsesACloudWithoutTransform) {
  RigInputs inputs = two_sensors({Cloud{0}, Cloud{100}}, {Cloud{0}, Cloud{100}});
  inputs.transforms = Transforms();
  inputs.transforms.add_fixed("base", "front", Pose::Identity());
  RigSource source(std::move(inputs), rig(), {});
  Frame frame;
  for (int i = 0; i < 2; ++i) {
    try {
      source.next(frame, 0ms);
      FAIL() << "a cloud without a transform was used";
    } catch (const FrameError& error) {
      EXPECT_THAT(error.what(), HasSubstr("/rear: no pose in base: no transform names the frame rear"));
    }
    ASSERT_EQ(source.next(frame, 0ms), Next::frame);
    EXPECT_EQ(stamps_of(frame), (Stamps{100 * i, -1}));
  }
  // A sensor of which nothing was used ends with an error, not quietly.
  EXPECT_THROW(source.next(frame, 0ms), std::runtime_error);
}

TEST(Rig, WaitsForTransformsOfLiveSensors) {
  class Feed final : public TransformFeed {
   public:
    void read(std::int64_t, Transforms& to) override {
      if (++calls_ == 5) to.add_fixed("base", "front", Pose::Identity());
    }
    std::vector<std::string> take_warnings() override { return {}; }

   private:
    int calls_ = 0;
  };
  RigInputs inputs;
  inputs.sensors.push_back(
      {std::make_unique<Sensor>("front", std::vector<Step>{Silence{}, Cloud{0}}, true), "/front", "", {}});
  inputs.feeds.push_back(std::make_unique<Feed>());
  RigConfig config = rig();
  config.sync_ms = 1000;
  RigSource source(std::move(inputs), config, stamped());
  Frame frame;
  ASSERT_EQ(source.next(frame, 900ms), Next::frame);
}

TEST(Rig, WaitsForThePoseOfALiveRobot) {
  // Gives the pose after the stamp only after some calls, as /tf comes later than the cloud.
  class Odometry final : public TransformFeed {
   public:
    void read(std::int64_t, Transforms& to) override {
      const int call = ++calls_;
      if (call == 1) to.add("odom", "base", 0, Pose::Identity());
      if (call == 9) to.add("odom", "base", 200 * kMs, Pose::Identity());
    }
    std::vector<std::string> take_warnings() override { return {}; }

   private:
    int calls_ = 0;
  };
  RigInputs inputs = two_sensors({Silence{}, Cloud{100}}, {Silence{}, Cloud{100}}, true);
  inputs.feeds.push_back(std::make_unique<Odometry>());
  RigConfig config = rig();
  config.fixed_frame = "odom";
  config.sync_ms = 900;
  RigSource source(std::move(inputs), config, {});
  Frame frame;
  ASSERT_EQ(source.next(frame, 800ms), Next::frame);
  EXPECT_TRUE(frame.pose);
}

TEST(Rig, ReportsAnUnreadableCloudAndGoesOn) {
  RigSource source(two_sensors({Cloud{0}, Broken{}, Cloud{100}}, {Cloud{0}, Cloud{100}}), rig(), {});
  EXPECT_THAT(frames_of(source), ElementsAre(Stamps{0, 0}, Stamps{}, Stamps{100, 100}));
}

TEST(Rig, NamesTheSensorAndTheNumberOfAnUnreadableCloudAndCountsItAsAFrame) {
  RigSource source(two_sensors({Cloud{0}, Broken{}}, {Cloud{0}}), rig(), {});
  Frame frame;
  ASSERT_EQ(source.next(frame, 0ms), Next::frame);
  try {
    source.next(frame, 0ms);
    FAIL() << "no error";
  } catch (const FrameError& error) {
    EXPECT_EQ(error.frame.file, "/front");
    EXPECT_EQ(error.frame.header.seq, 1U);
    EXPECT_EQ(error.reason, "cloud 12 (sweeps/12.pcd): cut off");
  }
}

TEST(Rig, OfASensorWhoseCloudsAreAllUnreadableIsAnErrorAtTheEnd) {
  RigSource source(two_sensors({Broken{}, Broken{}}, {Cloud{0}}), rig(), {});
  std::string why;
  try {
    frames_of(source);
  } catch (const std::runtime_error& error) {
    why = error.what();
  }
  EXPECT_EQ(why, "/front: none of its clouds was used: cloud 12 (sweeps/12.pcd): cut off");
}

TEST(Rig, PointsWithoutReturnBecomeNaNInsteadOfPointsAtTheSensor) {
  RigSource source(two_sensors({Cloud{0, {0, 0, 0, 1, 0, 0}}}, {}), rig(), {});
  Frame frame;
  ASSERT_EQ(source.next(frame, 0ms), Next::frame);
  EXPECT_TRUE(std::isnan(load_point(frame.points, 0).x));
  EXPECT_EQ(load_point(frame.points, 1).x, 2);
}

// 100 points over 0.1 s from `front`, which has times, and one from `rear`, which has none.
TEST(Rig, GivesEachPointItsTimeAfterTheStampOfTheFrame) {
  Cloud front{20, {}}, rear{0};
  for (int i = 0; i < 100; ++i) {
    front.xyz.insert(front.xyz.end(), {1, 2, 3});
    front.times_ns.push_back(1'000'000U * static_cast<std::uint32_t>(i));
  }
  ReplayOptions options;
  options.point_times = true;
  RigSource source(two_sensors({front}, {rear}), rig(), options);
  Frame frame;
  ASSERT_EQ(source.next(frame, 0ms), Next::frame);
  ASSERT_NE(frame.seconds, nullptr);
  EXPECT_NEAR(frame.seconds[0], 0.02, 1e-6);
  EXPECT_NEAR(frame.seconds[99], 0.119, 1e-6);
  EXPECT_EQ(frame.seconds[100], 0);
  RigSource without(two_sensors({front}, {rear}), rig(), {});
  ASSERT_EQ(without.next(frame, 0ms), Next::frame);
  EXPECT_EQ(frame.seconds, nullptr);
}

TEST(Rig, WarnsOnceOfTimesOfPointsThatAreUnusual) {
  Cloud front{0, {}}, rear{0, {0, 0, 0}};
  for (int i = 0; i < 100; ++i) {
    front.xyz.insert(front.xyz.end(), {1, 2, 3});
    front.times_ns.push_back(3'000'000'000U + 1'000'000U * static_cast<std::uint32_t>(i));
  }
  rear.times_ns.push_back(0);  // of a ray without a return
  ReplayOptions options;
  options.point_times = true;
  Cloud later_front = front, later_rear = rear;
  later_front.ms = later_rear.ms = 100;
  RigSource source(two_sensors({front, later_front}, {rear, later_rear}), rig(), options);
  EXPECT_THAT(frames_of(source), testing::SizeIs(2));
  EXPECT_THAT(source.take_warnings(),
              ElementsAre(HasSubstr("/front: the times of the points differ from the stamp by 3.0")));
}

// The robot drives by 1 m in each frame. The times of each sensor's points, in nanoseconds, are a constant
// plus multiples of a step.
struct RigTimes {
  bool known = false;
  std::uint32_t constant = 0, step = 0;
};
struct DeskewedRig {
  FrameResult result;
  std::string reported;
  std::vector<std::string> warnings;
};

DeskewedRig deskewed_rig(RigTimes front_times, RigTimes rear_times, std::int64_t rear_delay, Deskew deskew) {
  std::vector<Step> front, rear;
  for (int i = 0; i < 3; ++i) {
    for (const bool is_front : {true, false}) {
      const RigTimes& times = is_front ? front_times : rear_times;
      Cloud cloud{100 * i + (is_front ? 0 : rear_delay), {}};
      for (std::uint32_t k = 0; k < 100; ++k) {
        cloud.xyz.insert(cloud.xyz.end(), {5, 0.1F * static_cast<float>(k), 2});
        if (times.known) cloud.times_ns.push_back(times.constant + times.step * k);
      }
      (is_front ? front : rear).emplace_back(cloud);
    }
  }
  RigInputs inputs = two_sensors(front, rear);
  for (int i = -1; i < 5; ++i)
    inputs.transforms.add("odom", "base", 100 * i * kMs, pose_of_angles({1.0 * i, 0, 0}, {0, 0, 0}));
  RigConfig config = rig();
  config.fixed_frame = "odom";
  ReplayOptions options;
  options.point_times = true;
  RigSource source(std::move(inputs), config, options);
  PipelineConfig settings;
  settings.ground.method = GroundMethod::none;
  settings.volumes = {"aabb"};
  settings.deskew = deskew;
  FramePipeline pipeline(settings);
  FrameWarnings warnings;
  DeskewedRig made;
  Frame frame;
  while (source.next(frame, 0ms) == Next::frame) {
    pipeline.process(frame, made.result);
    made.reported = report_of(frame, made.result).deskew;
    for (std::string& line : warnings.take(frame, made.result))
      made.warnings.push_back(std::move(line));
    for (std::string& line : source.take_warnings())
      made.warnings.push_back(std::move(line));
  }
  return made;
}

TEST(Rig, NamesEachSensorWhosePointsHaveNoTimesOfASweep) {
  const std::string reason =
      ": points cannot be moved to the stamp: they have no times, or times that are not those of a sweep";
  const RigTimes none{}, zero{true, 0, 0}, constant{true, 50'000'000, 0}, long_sweep{true, 0, 40'000'000},
      sweep{true, 0, 1'000'000};
  for (const RigTimes& unusable : {none, zero, constant, long_sweep}) {
    SCOPED_TRACE(testing::Message() << unusable.known << unusable.constant << unusable.step);
    const DeskewedRig both = deskewed_rig(unusable, unusable, 0, Deskew::on);
    EXPECT_THAT(both.warnings, ElementsAre("/front, /rear" + reason));
    EXPECT_EQ(both.result.deskew.outcome, DeskewOutcome::no_times);
    EXPECT_EQ(both.reported, "");
    // The clouds are moved as a whole.
    const DeskewedRig apart = deskewed_rig(unusable, unusable, 20, Deskew::on);
    EXPECT_THAT(apart.warnings, ElementsAre("/front, /rear" + reason));
    ASSERT_TRUE(apart.result.deskew.moved());
    EXPECT_EQ(apart.result.deskew.times.unit, nullptr);
    EXPECT_EQ(apart.reported, "");
    EXPECT_NEAR(load_point(apart.result.deskew.points, 100).x, -2 - 5 + 0.2, 1e-5);
    const DeskewedRig one = deskewed_rig(sweep, unusable, 20, Deskew::on);
    EXPECT_THAT(one.warnings, ElementsAre("/rear" + reason));
    EXPECT_EQ(one.reported, "poses");
    const DeskewedRig quiet = deskewed_rig(unusable, unusable, 20, Deskew::automatic);
    EXPECT_THAT(quiet.warnings, testing::IsEmpty());
    EXPECT_EQ(quiet.reported, "");
  }
  const DeskewedRig known = deskewed_rig(sweep, sweep, 20, Deskew::on);
  EXPECT_THAT(known.warnings, testing::IsEmpty());
  EXPECT_EQ(known.reported, "poses");
}

TEST(Rig, HasThePoseOfTheRobotInTheFixedFrame) {
  RigInputs inputs = two_sensors({Cloud{0}, Cloud{100}}, {Cloud{0}, Cloud{100}});
  inputs.transforms.add("odom", "base", 0, pose_of_angles({7, 0, 0}, {0, 0, 0}));
  RigConfig config = rig();
  config.fixed_frame = "odom";
  RigSource source(std::move(inputs), config, {});
  Frame frame;
  ASSERT_EQ(source.next(frame, 0ms), Next::frame);
  ASSERT_TRUE(frame.pose);
  EXPECT_EQ(frame.pose->translation().x(), 7);
  ASSERT_EQ(source.next(frame, 0ms), Next::frame);
  EXPECT_FALSE(frame.pose);
}

TEST(Rig, MeasuresRangesFromEachSensor) {
  // 4 m ahead of `front`, which is 5 m from the robot's origin, and 4 m ahead of `rear`.
  RigSource source(two_sensors({Cloud{0, {4, 0, 0, 4.6F, 0, 0}}}, {Cloud{0, {4, 0, 0, 0.3F, 0, 0}}}), rig(),
                   {});
  Frame frame;
  ASSERT_EQ(source.next(frame, 0ms), Next::frame);
  PipelineConfig config;
  config.filter.range_min = 0.5;
  config.filter.range_max = 4.5;
  config.cluster.tolerance = 0.5;
  config.cluster.min_size = 1;
  config.ground.method = GroundMethod::none;
  FramePipeline pipeline(config);
  FrameResult result;
  pipeline.process(frame, result);
  EXPECT_EQ(result.counts.range, 2U);
  EXPECT_THAT(result.passed_filter, ElementsAre(0, 2));
}

TEST(Rig, ClearsTheMemoryOfAFrameOnlyWhenNobodyUsesIt) {
  RigSource source(two_sensors({Cloud{0, {1, 0, 0}}, Cloud{100, {2, 0, 0}}, Cloud{200, {3, 0, 0}}}, {}),
                   rig(), {});
  Frame first, second;
  ASSERT_EQ(source.next(first, 0ms), Next::frame);
  const std::byte* const memory = first.points.data;
  ASSERT_EQ(source.next(second, 0ms), Next::frame);
  EXPECT_EQ(load_point(first.points, 0).x, 2);
  EXPECT_EQ(load_point(second.points, 0).x, 3);
  first = Frame();
  ASSERT_EQ(source.next(first, 0ms), Next::frame);
  EXPECT_EQ(first.points.data, memory);
}

TEST(RigConfig, NamesWhatIsNotAllowed) {
  RigConfig config;
  config.sync_ms = 0;
  EXPECT_THAT(config.validate(), ElementsAre(HasSubstr("rig.sync_ms: 0 is not above 0")));
  config = {};
  config.sensors = {{"/a", "", {}}};
  EXPECT_THAT(config.validate(), ElementsAre(HasSubstr("rig.sensors: needs rig.frame")));
  config.frame = "base";
  EXPECT_THAT(config.validate(), IsEmpty());
  config.sensors.push_back({"/a", "", {}});
  EXPECT_THAT(config.validate(), ElementsAre(HasSubstr("topic /a is given twice")));
  config.sensors.back() = {"/b", "", {1, 2, 3}};
  EXPECT_THAT(config.validate(), ElementsAre(HasSubstr("the pose of /b is not x, y, z, roll")));
}

}  // namespace
}  // namespace pcl_bv::detail
