// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/frame_pipeline.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <functional>
#include <limits>
#include <thread>

#include "allocations.h"
#include "clouds.h"
#include "executions.h"
#include "frames.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/nodes/frame_source.h"
#include "pcl_bv/segmentation/up.h"

namespace pcl_bv::detail {
namespace {

PipelineConfig all_shapes() {
  PipelineConfig config;
  config.volumes = {"aabb", "dop26", "sphere-exact", "sphere-epos26", "obb-dito14", "obb-yaw"};
  config.track.enabled = true;
  config.cluster.min_extent = {0.1, 0.05, 0.1};
  config.cluster.max_extent = {25, 15, 9};
  return config;
}

TEST(Pipeline, EachPointOfAClusterIsInsideItsVolumes) {
  FramePipeline pipeline(all_shapes());
  FrameResult result;
  const auto frames = street(2);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const Frame frame = third_orientation(frames[f], f);
    pipeline.process(frame, result);
    ASSERT_GT(result.clusters.size(), 5U);
    for (std::size_t c = 0; c < result.clusters.size(); ++c) {
      PointView cluster = frame.points;
      cluster.indices = result.clusters.list(c);
      cluster.count = result.clusters.list_size(c);
      for (std::size_t m = 0; m < result.methods.size(); ++m)
        EXPECT_EQ(verify(result.volume(c, m), cluster).outside, 0U) << result.methods[m]->name;
    }
  }
}

TEST(Pipeline, CountsEachPointOnce) {
  FramePipeline pipeline;
  FrameResult result;
  std::vector<float> xyz = street(1)[0];
  xyz[0] = std::numeric_limits<float>::quiet_NaN();
  xyz[7] = std::numeric_limits<float>::infinity();
  pipeline.process(third_orientation(xyz, 0), result);
  const Counts& c = result.counts;
  EXPECT_EQ(c.nonfinite, 2U);
  EXPECT_GT(c.range, 100U);
  EXPECT_GT(c.ground, 1000U);
  EXPECT_EQ(c.nonfinite + c.range + c.ground + c.small + c.large + result.clusters.indices.size(),
            result.points);
}

TEST(Pipeline, CountsNoiseOnce) {
  PipelineConfig config;
  config.cluster.min_points = 8;
  FramePipeline pipeline(config);
  FrameResult result;
  const std::vector<float> xyz = street(1)[0];
  pipeline.process(third_orientation(xyz, 0), result);
  const Counts& c = result.counts;
  EXPECT_GT(c.noise, 100U);
  EXPECT_EQ(c.nonfinite + c.range + c.ground + c.small + c.large + c.noise + result.clusters.indices.size(),
            result.points);
  config.cluster.tolerance = 0;  // all points are one
  pipeline.set_config(config);
  pipeline.process(third_orientation(xyz, 1), result);
  EXPECT_EQ(result.counts.noise, 0U);
}

// Three rows of ten points, metres apart, of the classes 1, 2 and 3.
struct Rows {
  Rows() {
    for (int row = 0; row < 3; ++row) {
      for (int i = 0; i < 10; ++i) {
        xyz.insert(xyz.end(), {5 + 0.2F * static_cast<float>(i), 10 * static_cast<float>(row), 0});
        classes.push_back(row + 1);
      }
    }
  }
  Frame frame() const {
    Frame made = third_orientation(xyz, 0);
    made.classes = std::make_shared<const std::vector<std::int64_t>>(classes);
    return made;
  }
  std::vector<float> xyz;
  std::vector<std::int64_t> classes;
};

PipelineConfig classes_config(std::vector<ClassConfig> classes) {
  PipelineConfig config;
  config.ground.method = GroundMethod::none;
  config.cluster.min_size = 1;
  config.cluster.class_field = FieldName{"label"};
  config.cluster.classes = std::move(classes);
  config.volumes = {"aabb", "obb"};
  return config;
}

TEST(Pipeline, ClassesHaveSettingsOfTheirOwn) {
  ClassConfig fine{2}, dropped{3};
  fine.tolerance = 0.1;
  dropped.drop = true;
  FramePipeline pipeline(classes_config({fine, dropped}));
  FrameResult result;
  pipeline.process(Rows().frame(), result);
  ASSERT_EQ(result.class_of.size(), 11U);
  EXPECT_EQ(result.class_of[0], 1);
  EXPECT_EQ(result.clusters.list_size(0), 10U);
  for (std::size_t i = 1; i < 11; ++i)
    EXPECT_EQ(result.class_of[i], 2);
  EXPECT_EQ(result.counts.dropped_class, 10U);
}

TEST(Pipeline, ClassesHaveVolumesOfTheirOwn) {
  ClassConfig own{2};
  own.volumes = {"sphere", "obb"};
  PipelineConfig config = classes_config({own});
  config.track.enabled = true;
  config.track.birth = 1;
  FramePipeline pipeline(config);
  FrameResult result;
  for (int pass = 0; pass < 2; ++pass) {  // what another frame left must not show
    Rows rows;
    if (pass == 0) rows.classes.assign(30, 1);
    pipeline.process(rows.frame(), result);
  }
  std::vector<std::string> found;
  for (const ClusterEntry& entry : cluster_entries(result)) {
    std::string line = std::to_string(entry.class_value.value()) + ":";
    for (const VolumeEntry& volume : entry.volumes) {
      EXPECT_FALSE(empty(volume.volume)) << volume.method;
      line += " " + std::string(volume.method);
    }
    found.push_back(line);
    EXPECT_TRUE(entry.track);
  }
  EXPECT_EQ(found,
            (std::vector<std::string>{"1: aabb obb-min", "2: obb-min sphere-exact", "3: aabb obb-min"}));
  for (std::size_t m = 0; m < 3; ++m)
    EXPECT_EQ(result.is_requested(1, m), !empty(result.volume(1, m)));
}

TEST(Pipeline, VolumesOfAClassAreThoseOfTheClassAlone) {
  ClassConfig own{2};
  own.volumes = {"sphere", "dop26", "obb"};
  const Rows rows;
  FramePipeline pipeline(classes_config({own}));
  FrameResult all, alone;
  pipeline.process(rows.frame(), all);
  PipelineConfig config = classes_config({});
  config.volumes = own.volumes;
  pipeline.set_config(config);
  pipeline.process(rows.frame(), alone);
  for (std::size_t m = 0; m < 3; ++m) {
    const auto same = std::find(all.methods.begin(), all.methods.end(), alone.methods[m]);
    ASSERT_NE(same, all.methods.end());
    EXPECT_TRUE(alone.volume(1, m) == all.volume(1, static_cast<std::size_t>(same - all.methods.begin())));
  }
}

TEST(Pipeline, WithoutAPointGivesAnEmptyResultWithTheHeader) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::vector<float>& xyz :
       {std::vector<float>{}, {nan, 0, 0, 0, nan, 0}, {0, 0, 0, 0, 0, 0}, {3, 4, 0}}) {
    FramePipeline pipeline(all_shapes());
    FrameResult result;
    pipeline.process(third_orientation(street(1)[0], 0), result);
    pipeline.process(third_orientation(xyz, 5), result);
    EXPECT_EQ(result.header.seq, 5U);
    EXPECT_EQ(result.header.frame_id, "lidar");
    EXPECT_EQ(result.clusters.size(), 0U);
    EXPECT_TRUE(result.volumes.empty());
    EXPECT_EQ(result.points, xyz.size() / 3);
  }
}

TEST(Pipeline, GivesTheSameForEveryExecutionAndASecondTime) {
  const auto frames = street(4);
  std::vector<FrameResult> expected;
  for (const Isa isa : usable_isas()) {
    for (const std::size_t threads : {1, 2, 3}) {
      SCOPED_TRACE(std::string(isa_name(isa)) + ", threads " + std::to_string(threads));
      PipelineConfig config = all_shapes();
      config.isa = isa_name(isa);
      config.threads = threads;
      FramePipeline pipeline(config);
      for (std::size_t f = 0; f < frames.size(); ++f) {
        FrameResult result;
        pipeline.process(third_orientation(frames[f], f), result);
        if (expected.size() <= f) expected.push_back(result);
        expect_equal(result, expected[f]);
      }
    }
  }
}

TEST(Pipeline, AllocatesNothingOnTheSecondPass) {
  const auto frames = street(6);
  std::vector<Frame> sequence;
  for (std::size_t f = 0; f < frames.size(); ++f)
    sequence.push_back(third_orientation(frames[f], f));
  PipelineConfig config = all_shapes();
  config.volumes.emplace_back("obb-pca");
  FramePipeline pipeline(config);
  FrameResult result;
  for (const Frame& frame : sequence)
    pipeline.process(frame, result);
  for (Frame& frame : sequence) {
    frame.header.stamp_ns += 600'000'000;
    const std::size_t before = allocations();
    pipeline.process(frame, result);
    EXPECT_EQ(allocations(), before) << "frame " << frame.header.seq;
  }
}

TEST(Pipeline, RoomMadeBeforeChangesNoBit) {
  const auto frames = street(4);
  FramePipeline reserved(all_shapes()), plain(all_shapes());
  FrameResult a, b;
  reserved.reserve(frames[0].size() / 3, a);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const Frame frame = third_orientation(frames[f], f);
    reserved.process(frame, a);
    plain.process(frame, b);
    expect_equal(a, b);
  }
}

std::size_t page_faults_of(const std::function<void()>& work) {
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  work();
  getrusage(RUSAGE_SELF, &after);
  return static_cast<std::size_t>(after.ru_minflt - before.ru_minflt);
}

TEST(Pipeline, TheFirstFrameAfterRoomWasMadeTouchesAThirdOfTheFreshMemory) {
  const std::vector<float> xyz = street(1, 120'000)[0];
  const Frame frame = third_orientation(xyz, 0);
  FramePipeline reserved(all_shapes()), plain(all_shapes());
  FrameResult a, b;
  reserved.reserve(xyz.size() / 3, a);
  const std::size_t with_room = page_faults_of([&] { reserved.process(frame, a); });
  const std::size_t without = page_faults_of([&] { plain.process(frame, b); });
  EXPECT_LT(3 * with_room, without);
}

TEST(Pipeline, RoomIsMadeForEverySetting) {
  PipelineConfig config;
  config.ground.up = {-1, 2, 0.5};
  config.ground.sensor_height = 2;
  config.cluster.class_field = FieldName{"label"};
  FramePipeline pipeline(config);
  FrameResult result;
  pipeline.reserve(20'000, result);
  EXPECT_GT(result.clusters.size(), 50U);
  EXPECT_GT(result.counts.ground, 8'000U);
  pipeline.reserve(0, result);
  EXPECT_EQ(result.clusters.size(), 0U);
}

TEST(Pipeline, DropsTheOwnVehicle) {
  PipelineConfig config;
  config.ground.method = GroundMethod::none;
  config.cluster = {0, 1};
  config.filter = {0, 10, Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, 1)};
  FramePipeline pipeline(config);
  FrameResult result;
  const std::vector<float> xyz = {0, 0, 0, 1, 1, 1, 1.5F, 0, 0, 0, 9, 0, 0, 11, 0};
  pipeline.process(third_orientation(xyz, 0), result);
  EXPECT_EQ(result.counts.range, 3U);
  EXPECT_EQ(result.clusters.indices, (std::vector<std::int32_t>{2, 3}));
}

TEST(Pipeline, ANewConfigurationCountsFromTheNextFrame) {
  FramePipeline pipeline;
  FrameResult result;
  const auto frames = street(1);
  PipelineConfig config = pipeline.config();
  config.volumes = {"dop14"};
  pipeline.set_config(config);
  pipeline.process(third_orientation(frames[0], 0), result);
  ASSERT_EQ(result.methods.size(), 1U);
  EXPECT_EQ(result.methods[0]->name, "dop14");
  config.cluster.tolerance = -1;
  config.volumes = {"nothing"};
  try {
    pipeline.set_config(config);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("cluster.tolerance: -1"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("'nothing' is no method"), std::string::npos);
  }
  EXPECT_EQ(pipeline.config().volumes, (std::vector<std::string>{"dop14"}));
}

TEST(Pipeline, UprightBoxesStandAgainstGravityWhateverItsLength) {
  std::vector<float> xyz;
  for (int i = 0; i < 300; ++i)
    xyz.insert(xyz.end(), {5 + 0.01F * static_cast<float>(i), 0.3F * static_cast<float>(i % 5),
                           0.02F * static_cast<float>(i % 60)});
  PipelineConfig config;
  config.ground = {GroundMethod::none, {1e-40, 2e-40, -2e-40}, {}, {}, {}, {}};
  config.cluster.tolerance = 0;
  config.volumes = {"obb-yaw", "obb-lshape"};
  FramePipeline pipeline(config);
  FrameResult result;
  const Frame frame = third_orientation(xyz, 0);
  pipeline.process(frame, result);
  ASSERT_EQ(result.clusters.size(), 1U);
  MethodOptions options;
  options.up = normalized_up(config.ground.up);
  for (std::size_t m = 0; m < 2; ++m) {
    AnyVolume expected = *result.methods[m]->fit(frame.points, options);
    EXPECT_TRUE(result.volume(0, m) == expected) << result.methods[m]->name;
  }
}

TEST(Pipeline, TracksDoNotDependOnTheVolumesAskedFor) {
  const auto frames = street(4);
  std::vector<std::vector<std::optional<TrackEntry>>> expected;
  for (const char* volume : {"aabb", "sphere-exact"}) {
    PipelineConfig config;
    config.volumes = {volume};
    config.track.enabled = true;
    FramePipeline pipeline(config);
    FrameResult result;
    for (std::size_t f = 0; f < frames.size(); ++f) {
      pipeline.process(third_orientation(frames[f], f), result);
      if (expected.size() <= f) expected.push_back(result.tracks);
      EXPECT_EQ(result.tracks, expected[f]);
    }
  }
}

// The axes of a box keep their names and directions from frame to frame.
// A ball of points at 5 m/s, ten frames a second, whose driver writes these stamps.
std::vector<FrameResult> ball_with_stamps(const std::vector<std::int64_t>& stamps, bool recorded) {
  PipelineConfig config;
  config.ground.method = GroundMethod::none;
  config.cluster.tolerance = 1;
  config.cluster.min_size = 2;
  config.track.enabled = true;
  config.track.birth = 1;
  FramePipeline pipeline(config);
  std::vector<FrameResult> results;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    std::vector<float> xyz;
    for (int k = 0; k < 20; ++k)
      for (const float c : {10 + 0.5F * static_cast<float>(i) + 0.1F * static_cast<float>(k % 5),
                            0.1F * static_cast<float>(k / 5), 0.F})
        xyz.push_back(c);
    Frame frame = third_orientation(xyz, i);
    frame.header.stamp_ns = stamps[i];
    if (recorded) frame.recorded_ns = 7'000'000'000 + static_cast<std::int64_t>(i) * 100'000'000;
    pipeline.process(frame, results.emplace_back());
  }
  return results;
}

double speed_of(const FrameResult& result) {
  return result.tracks.at(0).value().velocity.norm();
}

TEST(Pipeline, TracksUseTheTimesOfRecordingWhereStampsDoNotAdvance) {
  const std::vector<std::int64_t> good{100, 200, 300, 400, 500, 600, 700, 800, 900, 1000}, equal(10, 100),
      backwards{1000, 900, 800, 700, 600, 500, 400, 300, 200, 100},
      pairs{100, 100, 300, 300, 500, 500, 700, 700, 900, 900},
      set_back{100, 200, 300, 400, 500, 10, 110, 210, 310, 410};
  const auto stamps = [](std::vector<std::int64_t> milliseconds) {
    for (std::int64_t& stamp : milliseconds)
      stamp *= 1'000'000;
    return milliseconds;
  };
  const double speed = speed_of(ball_with_stamps(stamps(good), false).back());
  EXPECT_NEAR(speed, 5, 0.1);
  for (const auto& bad : {equal, backwards, pairs, set_back}) {
    const std::vector<FrameResult> results = ball_with_stamps(stamps(bad), true);
    EXPECT_EQ(speed_of(results.back()), speed);
    EXPECT_TRUE(std::any_of(results.begin(), results.end(),
                            [](const FrameResult& one) { return one.track_time == TrackTime::recorded; }));
    EXPECT_EQ(track_warning(results.front()), "");
  }
  EXPECT_EQ(track_warning(ball_with_stamps(stamps(good), true).back()), "");
  EXPECT_EQ(track_warning(ball_with_stamps(stamps(equal), true).back()),
            "frame stamps do not advance: tracking uses the recording times");
  const FrameResult lost = ball_with_stamps(stamps(equal), false).back();
  EXPECT_EQ(speed_of(lost), 0);
  EXPECT_EQ(track_warning(lost), "frame stamps do not advance: tracks are expected at their last positions");
  // A clock that was set back costs one step, as before.
  EXPECT_EQ(ball_with_stamps(stamps(set_back), false).back().track_time, TrackTime::stamps);
}

TEST(Pipeline, BoxesOfATrackDoNotFlip) {
  PipelineConfig config;
  config.volumes = {"obb-yaw"};
  config.ground.method = GroundMethod::none;
  config.track.enabled = true;
  config.filter.range_min = 0;
  FramePipeline pipeline(config);
  FrameResult result;
  Eigen::Matrix3d before;
  for (int f = 0; f < 40; ++f) {
    std::vector<float> xyz;  // a nearly square block that turns by 6 degrees a frame
    for (int i = 0; i < 400; ++i) {
      const double u = (i % 20) / 9.5 - 1, v = (i / 20) / 9.5 - 1 + 0.01 * ((f * 7 + i) % 3), a = 0.105 * f;
      xyz.insert(xyz.end(),
                 {static_cast<float>(5 + std::cos(a) * u - std::sin(a) * v),
                  static_cast<float>(std::sin(a) * u + std::cos(a) * v), 0.1F * static_cast<float>(i % 5)});
    }
    pipeline.process(third_orientation(xyz, static_cast<std::size_t>(f)), result);
    ASSERT_EQ(result.clusters.size(), 1U);
    const Eigen::Matrix3d axes = std::get<Obb>(result.volume(0, 0)).axes();
    if (f > 0) {
      const double turned = Eigen::AngleAxisd(Eigen::Matrix3d(before.transpose() * axes)).angle();
      EXPECT_LT(turned, 0.25) << "frame " << f;
    }
    before = axes;
  }
}

TEST(Pipeline, ItsConfigurationMayChangeWhileAFrameIsInWork) {
  PipelineConfig one, two;
  one.volumes = {"aabb"};
  two.volumes = {"sphere", "aabb"};
  two.cluster.min_size = 40;
  const std::vector<std::vector<float>> clouds = street(1);
  const Frame frame = third_orientation(clouds[0], 0);
  std::vector<FrameResult> expected(2);
  FramePipeline(one).process(frame, expected[0]);
  FramePipeline(two).process(frame, expected[1]);
  FramePipeline pipeline(one);
  std::atomic<bool> done{false};
  std::thread changing([&] {
    for (int i = 0; !done; ++i)
      pipeline.set_config(i % 2 == 0 ? two : one);
  });
  for (int i = 0; i < 20; ++i) {
    FrameResult result;
    pipeline.process(frame, result);
    expect_equal(result, expected[result.methods.size() - 1]);
  }
  done = true;
  changing.join();
}

}  // namespace
}  // namespace pcl_bv::detail
