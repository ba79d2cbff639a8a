// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tracks where the times of frames are missing, jump or begin anew.

#include <gmock/gmock.h>

#include <set>

#include "commands/bv_stream/pass_stamps.h"
#include "pcl_bv/nodes/frame_pipeline.h"

namespace pcl_bv::detail {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kStep = 100'000'000;  // 10 frames a second

PipelineConfig tracked() {
  PipelineConfig config;
  config.ground.method = GroundMethod::none;
  config.cluster.tolerance = 1;
  config.cluster.min_size = 2;
  config.track.enabled = true;
  config.track.birth = 1;
  return config;
}

// A pipeline that sees a block at 10 m, which moves by 0.5 m a frame.
class Block {
 public:
  explicit Block(PipelineConfig config = tracked()) : pipeline(std::move(config)) {}

  const FrameResult& see(std::int64_t stamp_ns, std::uint64_t pass = 0) {
    xyz_.clear();
    for (int k = 0; k < 20; ++k)
      xyz_.insert(xyz_.end(), {10 + 0.5F * static_cast<float>(frame_) + 0.1F * static_cast<float>(k % 5),
                               0.1F * static_cast<float>(k / 5), 0.F});
    ++frame_;
    Frame frame;
    frame.header.stamp_ns = stamp_ns;
    frame.pass = pass;
    frame.points = PointView::of(xyz_.data(), 12, xyz_.size() / 3);
    pipeline.process(frame, result);
    return result;
  }
  std::uint32_t id() const { return result.tracks.at(0).value().id; }
  double speed() const { return result.tracks.at(0).value().velocity.norm(); }
  void put_back() { frame_ = 0; }

  FramePipeline pipeline;
  FrameResult result;

 private:
  std::vector<float> xyz_;
  int frame_ = 0;
};

TEST(TrackTimes, AResultWarnsOnceOfTracksWithoutStamps) {
  Block block;
  EXPECT_THAT(block.see(0).warnings, IsEmpty());
  EXPECT_THAT(block.see(0).warnings,
              ElementsAre("frame stamps do not advance: tracks are expected at their last positions"));
  EXPECT_EQ(block.speed(), 0);
  EXPECT_THAT(block.see(0).warnings, IsEmpty());
  block.pipeline.set_warnings(FrameWarnings());
  EXPECT_EQ(block.see(0).warnings.size(), 1U);
}

TEST(TrackTimes, AResultWithoutTracksNeedsNoStamps) {
  PipelineConfig config = tracked();
  config.track.enabled = false;
  Block block(config);
  for (int i = 0; i < 3; ++i)
    EXPECT_THAT(block.see(0).warnings, IsEmpty());
}

TEST(TrackTimes, ReservingMemoryTakesNoWarning) {
  Block block;
  block.pipeline.reserve(1000, block.result);
  block.see(0);
  EXPECT_EQ(block.see(0).warnings.size(), 1U);
}

TEST(TrackTimes, FramesMoreThanASecondApartAreSaid) {
  Block block;
  block.see(0);
  EXPECT_THAT(block.see(1'000'000'000).warnings, IsEmpty());
  EXPECT_THAT(block.see(2'000'000'001).warnings,
              ElementsAre("frames are more than 1 s apart: tracks are expected at their last positions"));
  EXPECT_EQ(block.result.track_time, TrackTime::gap);
}

// The stamps of a recording that is played again: the last one may be any, the first one may be 0.
TEST(TrackTimes, AStampThatGoesBackByMoreThanASecondBeginsNewTracks) {
  for (const std::int64_t first : {std::int64_t{0}, std::int64_t{1'700'000'000'000'000'000}}) {
    Block block;
    std::set<std::uint32_t> before;
    for (int i = 0; i < 20; ++i) {
      EXPECT_THAT(block.see(first + i * kStep).warnings, IsEmpty());
      before.insert(block.id());
    }
    EXPECT_NEAR(block.speed(), 5, 0.2);
    for (int i = 0; i < 20; ++i) {
      const std::vector<std::string> warnings = block.see(first + i * kStep).warnings;
      if (i == 0) {
        EXPECT_THAT(warnings, ElementsAre("frame stamps went back by more than 1 s: tracks begin anew"));
      } else {
        EXPECT_THAT(warnings, IsEmpty());
      }
      EXPECT_FALSE(before.contains(block.id())) << i;
      EXPECT_EQ(block.result.active_tracks.size(), 1U);
    }
    EXPECT_NEAR(block.speed(), 5, 0.2);
  }
}

TEST(TrackTimes, AStampThatGoesBackByLessIsThatOfAClockThatWasSet) {
  Block block;
  for (int i = 0; i < 10; ++i)
    block.see(i * kStep);
  const std::uint32_t id = block.id();
  block.see(0);
  EXPECT_EQ(block.id(), id);
  EXPECT_EQ(block.result.track_time, TrackTime::none);
}

TEST(TrackTimes, AnotherPassOverASourceBeginsNewTracks) {
  Block block;
  std::set<std::uint32_t> before;
  for (int i = 0; i < 10; ++i) {
    block.see(i * kStep);
    before.insert(block.id());
  }
  block.put_back();
  for (int i = 10; i < 20; ++i) {
    EXPECT_THAT(block.see(i * kStep, 1).warnings, IsEmpty());
    EXPECT_FALSE(before.contains(block.id())) << i;
  }
  EXPECT_NEAR(block.speed(), 5, 0.2);
}

std::vector<std::int64_t> moved(const std::vector<std::int64_t>& stamps, std::uint64_t passes) {
  PassStamps ascending;
  std::vector<std::int64_t> all;
  for (std::uint64_t pass = 0; pass < passes; ++pass) {
    for (const std::int64_t stamp : stamps) {
      Frame frame;
      frame.header.stamp_ns = stamp;
      frame.pass = pass;
      ascending.move(frame);
      all.push_back(frame.header.stamp_ns);
    }
  }
  return all;
}

TEST(PassStamps, AscendOverThePassesOfASource) {
  EXPECT_THAT(moved({10, 20, 40}, 3), ElementsAre(10, 20, 40, 55, 65, 85, 100, 110, 130));
  EXPECT_THAT(moved({7}, 3), ElementsAre(7, 7 + kStep, 7 + 2 * kStep));
  EXPECT_THAT(moved({20, 10}, 2), ElementsAre(20, 10, 30, 20));  // as far back as in the file
  EXPECT_THAT(moved({INT64_MIN, INT64_MAX}, 2), ElementsAre(INT64_MIN, INT64_MAX, INT64_MIN, INT64_MAX));
}

TEST(PassStamps, ThatAscendAlreadyStay) {
  PassStamps ascending;
  for (std::int64_t i = 0; i < 6; ++i) {
    Frame frame;
    frame.header.stamp_ns = 100 * i;
    frame.pass = static_cast<std::uint64_t>(i / 3);
    ascending.move(frame);
    EXPECT_EQ(frame.header.stamp_ns, 100 * i);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
