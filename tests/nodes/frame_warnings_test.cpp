// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What is said of a frame, and what a stream pays for it.
#include "pcl_bv/nodes/frame_result.h"

#include <gmock/gmock.h>

#include "frames.h"
#include "pcl_bv/messages/results.h"
#include "pcl_bv/nodes/topics.h"

namespace pcl_bv::detail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<float> upside_down() {
  std::vector<float> xyz = street(1)[0];
  for (std::size_t i = 0; i < xyz.size(); ++i)
    if (i % 3 != 0) xyz[i] = -xyz[i];
  return xyz;
}

// A frame of which little is ground.
FrameResult little_ground(const std::vector<float>& xyz, const std::shared_ptr<PipelineConfig>& config) {
  FrameResult result;
  result.config = config;
  result.points = xyz.size() / 3;
  result.counts.ground = result.points / 20;
  return result;
}

std::shared_ptr<PipelineConfig> plane() {
  PipelineConfig config;
  config.ground.method = GroundMethod::plane;
  return std::make_shared<PipelineConfig>(config);
}

TEST(FrameWarnings, SearchAnotherUpDirectionOnceUnderAConfiguration) {
  const std::vector<float> upright = street(1)[0], turned = upside_down();
  const auto config = plane();
  FrameWarnings first;
  EXPECT_THAT(first.take(third_orientation(turned, 0), little_ground(turned, config)),
              ElementsAre(HasSubstr("use ground.up -z")));
  FrameWarnings warnings;
  EXPECT_THAT(warnings.take(third_orientation(upright, 0), little_ground(upright, config)), IsEmpty());
  EXPECT_THAT(warnings.take(third_orientation(turned, 1), little_ground(turned, config)), IsEmpty());
  EXPECT_THAT(warnings.take(third_orientation(turned, 2), little_ground(turned, plane())),
              ElementsAre(HasSubstr("use ground.up -z")));
}

TEST(StreamHealth, SaysThatFramesWereLostBesideAWarning) {
  const std::vector<float> turned = upside_down();
  const auto config = plane();
  StreamHealth health;
  health.record_frame(third_orientation(turned, 0), little_ground(turned, config));
  msg::DiagnosticArray array;
  health.fill(third_orientation(turned, 0), array);
  EXPECT_THAT(array.status.at(0).message, HasSubstr("use ground.up -z"));
  health.count_lost();
  health.fill(third_orientation(turned, 1), array);
  EXPECT_THAT(array.status.at(0).message, testing::StartsWith("frames were lost; "));
  EXPECT_THAT(array.status.at(0).message, HasSubstr("use ground.up -z"));
}

}  // namespace
}  // namespace pcl_bv::detail
