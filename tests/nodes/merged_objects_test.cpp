// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A cluster that is several objects for a while gives none of them its size.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "frames.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pipeline/track/tracker.h"

namespace pcl_bv::detail {
namespace {

Aabb box(double x, double y, double length, double width) {
  return {{x - length / 2, y - width / 2, 0}, {x + length / 2, y + width / 2, 1.5}};
}

std::vector<Tracker::Assignment> update(Tracker& tracker, int frame, const std::vector<Aabb>& boxes) {
  std::vector<Tracker::Assignment> assignments;
  tracker.update(frame * 100'000'000LL, boxes, {}, assignments);
  return assignments;
}

TEST(MergedObjects, AreSaidWhileATrackWithoutABoxIsExpectedInsideAnothersBox) {
  Tracker tracker;
  for (int i = 0; i < 5; ++i)
    for (const Tracker::Assignment& a : update(tracker, i, {box(0, 0, 4, 2), box(0, 2.4, 4, 2)}))
      EXPECT_FALSE(a.merged || a.separated) << i;
  for (int i = 5; i < 12; ++i)
    EXPECT_TRUE(update(tracker, i, {box(0, 1.2, 4, 4.4)})[0].merged) << i;
  for (int i = 12; i < 20; ++i)
    for (const Tracker::Assignment& a : update(tracker, i, {box(0, 0, 4, 2), box(0, 2.4, 4, 2)}))
      EXPECT_FALSE(a.merged || a.separated) << i;
}

// A mirror that was a cluster of its own for a while must not hold the box of its van for ever.
TEST(MergedObjects, AreNoneWhereTheTrackOfAPartIsExpectedInTheWhole) {
  Tracker tracker;
  for (int i = 0; i < 20; ++i) {
    std::vector<Aabb> boxes{box(0, 0, 4, 2)};
    if (i < 8) boxes.push_back(box(1.2, 0.6, 0.5, 0.5));
    const auto found = update(tracker, i, boxes);
    EXPECT_FALSE(found[0].merged) << i;
    ASSERT_TRUE(i != 7 || found[1].track);
  }
}

TEST(MergedObjects, AreSaidOfAnObjectWhoseTrackWasThatOfAPartBefore) {
  Tracker tracker;
  for (int i = 0; i <= 20; ++i) {
    std::vector<Aabb> boxes{box(0, 0, 4, 2)};
    if (i < 8) boxes.push_back(box(1.2, 0.6, 0.5, 0.5));
    if (i >= 10 && i < 20) boxes.push_back(box(1.2, 0.6 + 0.15 * (i - 9), 0.5, 0.5));  // it walks away
    if (i == 20) boxes = {box(0, 0.7, 4, 3.4)};
    const auto found = update(tracker, i, boxes);
    EXPECT_EQ(found[0].merged, i == 20) << i;
  }
}

TEST(MergedObjects, AreNoneWhereATrackThatWasNeverBornIsExpected) {
  Tracker tracker;
  for (int i = 0; i < 6; ++i) {
    std::vector<Aabb> boxes{box(0, 0, 4, 2)};
    if (i == 3) boxes.push_back(box(1, 1.2, 0.3, 0.2));  // seen once
    EXPECT_FALSE(update(tracker, i, boxes)[0].merged) << i;
  }
}

TEST(MergedObjects, AreSaidToBeSeparatedOnceWhenWhatCameOutOfThemHasBeenSeenForFiveFrames) {
  Tracker tracker;
  for (int i = 0; i < 30; ++i)
    EXPECT_FALSE(update(tracker, i, {box(0, 1.2, 4, 4.4)})[0].separated);
  for (int i = 30; i < 45; ++i) {
    const auto found = update(tracker, i, {box(0, 0, 4, 2.2), box(0, 2.4, 4, 1.8)});
    ASSERT_EQ(found[0].track->id, 0U);
    EXPECT_EQ(found[0].separated, i == 34) << i;
    EXPECT_FALSE(found[1].separated) << i;
  }
}

TEST(MergedObjects, AreNotSeparatedByWhatIsSeenForAFrameOrTwo) {
  Tracker tracker;
  for (int i = 0; i < 40; ++i) {
    std::vector<Aabb> boxes{box(0, 0, 4, 2)};
    if (i % 10 == 5 || i % 10 == 6) boxes = {box(-0.5, 0, 3, 2), box(1.7, 0, 0.4, 2)};
    for (const Tracker::Assignment& a : update(tracker, i, boxes))
      EXPECT_FALSE(a.separated) << i;
  }
}

// The sides and the top of a car of 4 x 1.8 x 1.5 m, a point each 20 cm.
void add_car(double x, double y, std::vector<float>& xyz) {
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; j <= 9; ++j)
      for (int k = 0; k <= 7; ++k) {
        if (i % 20 != 0 && j % 9 != 0 && k != 7) continue;
        for (const double c : {x - 2 + 0.2 * i, y - 0.9 + 0.2 * j, 1.5 * k / 7})
          xyz.push_back(static_cast<float>(c));
      }
}

struct Seen {
  Eigen::Vector3d size;
  std::size_t frame;
};

// The last box of each track, by id.
template <typename Scene>
std::map<std::uint32_t, Seen> last_boxes(const char* method, bool smooth, std::size_t frames,
                                         const Scene& scene) {
  PipelineConfig config;
  config.volumes = {method};
  config.ground.method = GroundMethod::none;
  config.filter.range_min = 0;
  config.track.enabled = config.track.grow = true;
  config.track.smooth = smooth;
  FramePipeline pipeline(config);
  FrameResult result;
  std::map<std::uint32_t, Seen> last;
  for (std::size_t f = 0; f < frames; ++f) {
    const std::vector<float> xyz = scene(static_cast<double>(f));
    pipeline.process(third_orientation(xyz, f), result);
    for (std::size_t c = 0; c < result.clusters.size(); ++c)
      if (result.tracks[c])
        last[result.tracks[c]->id] = {2 * std::get<Obb>(result.volume(c, 0)).half_extents(), f};
  }
  return last;
}

void expect_cars(const std::map<std::uint32_t, Seen>& last, std::size_t frames) {
  std::size_t cars = 0;
  for (const auto& [id, seen] : last) {
    if (seen.frame + 1 != frames) continue;
    ++cars;
    EXPECT_NEAR(seen.size.x(), 4, 0.35) << id;
    EXPECT_NEAR(seen.size.y(), 1.8, 0.35) << id;
    EXPECT_NEAR(seen.size.z(), 1.5, 1e-5) << "the height is along the third axis";
  }
  EXPECT_EQ(cars, 2U);
}

TEST(MergedObjects, TwoCarsThatPassCloseHaveTheirSizesAfterwards) {
  for (const char* method : {"obb-yaw", "obb-lshape"})
    for (const bool smooth : {false, true}) {
      SCOPED_TRACE(method);
      const auto scene = [](double frame) {  // 0.4 m apart, below the tolerance, for 10 frames
        std::vector<float> xyz;
        add_car(-12 + 0.5 * frame, 4, xyz);
        add_car(12 - 0.5 * frame, 6.2, xyz);
        return xyz;
      };
      expect_cars(last_boxes(method, smooth, 48, scene), 48);
    }
}

TEST(MergedObjects, TwoCarsThatWereOneFromTheBeginningHaveTheirSizesOnceTheyPart) {
  for (const char* method : {"obb-yaw", "obb-lshape"})
    for (const bool smooth : {false, true}) {
      SCOPED_TRACE(method);
      const auto scene = [](double frame) {
        std::vector<float> xyz;
        add_car(8, 4, xyz);
        add_car(8 + 0.4 * std::max(0.0, frame - 30), 6.2, xyz);
        return xyz;
      };
      expect_cars(last_boxes(method, smooth, 60, scene), 60);
    }
}

}  // namespace
}  // namespace pcl_bv::detail
