// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pipeline/track/tracker.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/synth/street.h"
#include "pipeline/track/box_grid.h"
#include "pipeline/track/occlusion.h"

namespace pcl_bv::detail {
namespace {

Aabb box(double x, double y, double size = 1) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(size / 2), center(x, y, 0);
  return {center - half, center + half};
}

std::optional<std::uint32_t> id_of(const Tracker::Assignment& assignment) {
  return assignment.track ? std::optional(assignment.track->id) : std::nullopt;
}

std::vector<Tracker::Assignment> update(Tracker& tracker, int frame, const std::vector<Aabb>& boxes,
                                        const TrackConfig& config = {}) {
  std::vector<Tracker::Assignment> assignments;
  tracker.update(frame * 100'000'000LL, boxes, config, assignments);
  return assignments;
}

TEST(Tracker, AnObjectGetsItsIdWithItsBirth) {
  Tracker tracker;
  EXPECT_FALSE(update(tracker, 0, {box(0, 0)})[0].track);
  EXPECT_FALSE(update(tracker, 1, {box(0.1, 0)})[0].track);
  EXPECT_EQ(id_of(update(tracker, 2, {box(0.2, 0)})[0]), 0U);
  EXPECT_EQ(id_of(update(tracker, 3, {box(0.3, 0)})[0]), 0U);
}

TEST(Tracker, SaysHowOldAndHowFastAnObjectIs) {
  TrackConfig config;
  config.birth = 1;
  Tracker tracker;
  for (int i = 0; i < 6; ++i) {
    if (i == 3) {  // not seen
      update(tracker, i, {}, config);
      continue;
    }
    const TrackEntry track = update(tracker, i, {box(0.5 * i, 0)}, config)[0].track.value();
    EXPECT_EQ(track.age, static_cast<std::size_t>(i) + 1);
    const double speed = i > 0 ? 5 : 0;
    EXPECT_NEAR((track.velocity - Eigen::Vector3d(speed, 0, 0)).norm(), 0, 1e-9) << i;
  }
  const auto other = update(tracker, 6, {box(3, 0), box(20, 0)}, config);
  EXPECT_EQ(other[0].track->age, 7U);
  ASSERT_TRUE(other[1].track);
  EXPECT_EQ(other[1].track->id, 1U);
  EXPECT_EQ(other[1].track->age, 1U);
  EXPECT_EQ(other[1].track->velocity, Eigen::Vector3d::Zero());
  EXPECT_EQ(other[1].track->pose, (std::array<double, 4>{20, 0, 0, 0}));
}

TEST(Tracker, KeepsIdsWhereObjectsCross) {
  Tracker tracker;
  for (int i = 0; i < 20; ++i) {
    const double x = -5 + 0.5 * i;
    const auto found = update(tracker, i, {box(x, 0.6), box(-x, -0.6)});
    if (i < 2) continue;
    EXPECT_EQ(id_of(found[0]), 0U) << i;
    EXPECT_EQ(id_of(found[1]), 1U) << i;
  }
}

TEST(Tracker, BridgesGapsShorterThanDeathAndNeverReusesIds) {
  TrackConfig config;
  config.death = 3;
  Tracker tracker;
  for (int i = 0; i < 4; ++i)
    update(tracker, i, {box(0.5 * i, 0)}, config);
  update(tracker, 4, {}, config);
  update(tracker, 5, {}, config);
  EXPECT_EQ(id_of(update(tracker, 6, {box(3, 0)}, config)[0]), 0U);
  for (int i = 7; i < 10; ++i)
    update(tracker, i, {}, config);
  for (int i = 10; i < 12; ++i)
    EXPECT_FALSE(update(tracker, i, {box(3, 0)}, config)[0].track);
  EXPECT_EQ(id_of(update(tracker, 12, {box(3, 0)}, config)[0]), 1U);
  tracker.reset();
  for (int i = 0; i < 2; ++i)
    update(tracker, i, {box(3, 0)}, config);
  EXPECT_EQ(id_of(update(tracker, 2, {box(3, 0)}, config)[0]), 2U);
}

// A person behind a van has no measurement for two seconds.
TEST(Tracker, AnObjectHiddenBehindAnotherKeepsItsId) {
  for (const bool hidden : {true, false}) {
    Tracker tracker;
    const Aabb van({9, -2, -1}, {10, 2, 1}), person = box(15, 0, 0.6);
    for (int i = 0; i < 5; ++i)
      update(tracker, i, {person});
    for (int i = 5; i < 25; ++i)
      update(tracker, i, hidden ? std::vector<Aabb>{van} : std::vector<Aabb>{});
    EXPECT_EQ(id_of(update(tracker, 25, {person})[0]), hidden ? std::optional(0U) : std::nullopt);
  }
}

// A rear part of a parked car is a cluster of its own for three frames, twice: two tracks of the car would
// then take turns.
TEST(Tracker, APartThatIsTheWholeAgainHasNoTrackOfItsOwn) {
  Tracker tracker;
  const Aabb car({10, 5, 0}, {14.4, 7, 1.5}), front({10, 5, 0}, {12.8, 7, 1.5}),
      rear({13, 5, 0}, {14.4, 7, 1.5});
  for (int i = 0; i < 20; ++i)
    update(tracker, i, {car});
  for (int i = 20; i < 23; ++i)
    EXPECT_EQ(id_of(update(tracker, i, {front, rear})[0]), 0U) << i;
  update(tracker, 23, {car});
  const std::vector<Tracker::Assignment> again = update(tracker, 24, {front, rear});
  EXPECT_EQ(id_of(again[0]), 0U);
  EXPECT_TRUE(again[1].fresh);
}

// A truck beside the vehicle hides 22 of 30 posts, and both brake.
TEST(Tracker, FindsTheMotionOfTheSensorWhileMostObjectsAreHidden) {
  std::vector<Eigen::Vector3d> posts;
  for (int i = 0; i < 22; ++i)
    posts.emplace_back(14 + 1.5 * i, 16 + i % 3, 0);
  for (int i = 0; i < 8; ++i)
    posts.emplace_back(5 + 4.5 * i, -6 - i % 4, 0);
  const Aabb truck({-12, 3, -1}, {18, 5, 3});
  Tracker tracker;
  double x = 0;
  for (int i = 0; i < 30; ++i) {
    const double speed = i < 10 ? 10 : std::max(4.0, 10 - 0.9 * (i - 9));
    x += 0.1 * speed;
    std::vector<Aabb> boxes;
    for (const Eigen::Vector3d& post : posts)
      if (i < 10 || !occludes(truck, post - Eigen::Vector3d(x, 0, 0)))
        boxes.push_back(box(post.x() - x, post.y(), 0.4));
    if (i >= 10) boxes.push_back(truck);
    const std::size_t seen = boxes.size();
    ASSERT_TRUE(i < 10 || seen <= 14) << i;
    const std::vector<Tracker::Assignment> found = update(tracker, i, boxes);
    for (std::size_t b = 0; i >= 10 && b + 1 < seen; ++b) {
      EXPECT_LT(found[b].velocity.norm(), 0.5) << i << ' ' << b;
      EXPECT_FALSE(found[b].moving) << i << ' ' << b;
    }
  }
}

// The front of a car is seen, then nothing, then its rear.
TEST(Tracker, APartOfACarThatComesIntoViewElsewhereHasTheIdOfTheCar) {
  Tracker tracker;
  const auto part = [](double from, double to) { return Aabb({from, 5, 0}, {to, 6.8, 1.5}); };
  for (int i = 0; i < 10; ++i)
    update(tracker, i, {part(10, 14.5)});
  for (int i = 10; i < 20; ++i)
    EXPECT_EQ(id_of(update(tracker, i, {part(10, 11.5)})[0]), 0U) << i;
  for (int i = 20; i < 23; ++i)
    update(tracker, i, {});
  for (int i = 23; i < 30; ++i)
    EXPECT_EQ(id_of(update(tracker, i, {part(13, 14.5)})[0]), 0U) << i;
}

TEST(Tracker, AnObjectBeyondTheGateIsAnother) {
  Tracker tracker;
  for (int i = 0; i < 4; ++i)
    update(tracker, i, {box(0, 0)});
  EXPECT_TRUE(update(tracker, 4, {box(2.5, 0)})[0].fresh);
}

TEST(Tracker, AWallIsNoPedestrian) {
  Tracker tracker;
  for (int i = 0; i < 4; ++i)
    update(tracker, i, {box(0, 0, 0.5)});
  EXPECT_TRUE(update(tracker, 4, {Aabb({20, -1, -1}, {60, 1, 1})})[0].fresh);
}

TEST(Tracker, AGapBeforeTheSecondSightingDoesNotDoubleTheVelocity) {
  TrackConfig config;
  config.gate = 3;
  Tracker tracker;
  update(tracker, 0, {box(0, 0)}, config);
  update(tracker, 1, {}, config);
  update(tracker, 2, {box(2, 0)}, config);  // 10 m/s, not 20
  config.gate = 0.5;
  EXPECT_EQ(id_of(update(tracker, 3, {box(3, 0)}, config)[0]), 0U);
}

// Stamps 0, 1 or 100 ms apart, whatever the time was; places to 3 cm.
TEST(Tracker, KeepsTheIdHoweverStampsJitter) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    const auto noise = [&] { return 0.06 * (static_cast<double>(random()) / 4294967296.0 - 0.5); };
    Tracker tracker;
    std::vector<Tracker::Assignment> found;
    std::int64_t stamp = 0;
    for (int i = 0; i < 60; ++i) {
      const std::int64_t steps[] = {0, 1'000'000, 100'000'000};
      stamp += steps[random() % 3];
      tracker.update(stamp, {box(noise(), 10 + noise())}, {}, found);
      if (i < 2) continue;
      ASSERT_EQ(id_of(found[0]), 0U) << "seed " << seed << " frame " << i;
      ASSERT_LT(found[0].track->velocity.norm(), 2) << "seed " << seed << " frame " << i;
      ASSERT_FALSE(found[0].moving) << "seed " << seed << " frame " << i;
    }
  }
}

TEST(Tracker, StampsThatGoBackOrJumpCostNoId) {
  Tracker tracker;
  std::vector<Tracker::Assignment> found;
  std::int64_t stamp = 5'000'000'000;
  for (int i = 0; i < 40; ++i) {
    tracker.update(stamp, {box(3 + 0.3 * i, 10)}, {}, found);
    stamp += i % 4 == 1 ? -300'000'000 : i % 4 == 3 ? 60'000'000'000 : 100'000'000;
    if (i < 2) continue;
    ASSERT_EQ(id_of(found[0]), 0U) << i;
    ASSERT_LT(found[0].track->velocity.norm(), 10) << i;
  }
  tracker.update(std::numeric_limits<std::int64_t>::min(), {box(3 + 0.3 * 40, 10)}, {}, found);
  EXPECT_EQ(id_of(found[0]), 0U);
}

TEST(Tracker, KeepsIdsWhileTheOwnVehicleTurns) {
  for (const bool posed : {true, false}) {
    std::vector<Eigen::Vector2d> places;
    for (int i = 0; i < 40; ++i)
      places.push_back((i % 2 == 0 ? 50 : 25 + i / 2) *
                       Eigen::Vector2d(std::cos(0.157 * i), std::sin(0.157 * i)));
    Tracker tracker;
    std::vector<Tracker::Assignment> found;
    for (int f = 0; f < 30; ++f) {
      Pose pose = Pose::Identity();
      pose.linear() = Eigen::AngleAxisd(0.0524 * f, Eigen::Vector3d::UnitZ()).toRotationMatrix();  // 30 deg/s
      pose.translation() << 0.5 * f, 0, 0;
      std::vector<Aabb> boxes;
      for (const Eigen::Vector2d& place : places) {
        const Eigen::Vector3d at = pose.inverse() * Eigen::Vector3d(place.x(), place.y(), 0);
        boxes.push_back(box(at.x(), at.y()));
      }
      tracker.update(f * 100'000'000LL, boxes, {}, found, posed ? std::optional(pose) : std::nullopt);
      for (std::size_t i = 0; f >= 2 && i < boxes.size(); ++i) {
        ASSERT_EQ(id_of(found[i]), i) << "frame " << f << " posed " << posed;
        ASSERT_FALSE(found[i].moving) << "frame " << f << " posed " << posed;
        if (posed) {
          ASSERT_LT(found[i].track->velocity.norm(), 1e-6) << f;
        }
      }
    }
  }
}

TEST(Tracker, AnObjectThatMergesWithAnotherKeepsItsId) {
  Tracker tracker;
  for (int i = 0; i < 5; ++i)
    update(tracker, i, {box(0, 0, 2), box(2.2, 0, 1)});
  for (int i = 5; i < 15; ++i)  // twice as long as an object that is not seen lives
    EXPECT_EQ(id_of(update(tracker, i, {Aabb({-1, -1, -1}, {2.7, 1, 1})})[0]), 0U);
  const auto found = update(tracker, 15, {box(0, 0, 2), box(2.2, 0, 1)});
  EXPECT_EQ(id_of(found[0]), 0U);
  EXPECT_EQ(id_of(found[1]), 1U);
}

TEST(Tracker, KeepsTheIdOfAnObjectThatBrakesAndTurns) {
  Tracker tracker;
  Eigen::Vector2d at(-20, 0);
  double speed = 12, yaw = 0;
  for (int i = 0; i < 60; ++i) {
    const auto found = update(tracker, i, {box(at.x(), at.y(), 2)});
    if (i >= 2) {
      ASSERT_EQ(id_of(found[0]), 0U) << i;
    }
    if (i == 30) {
      EXPECT_TRUE(found[0].moving);
    }
    at += 0.1 * speed * Eigen::Vector2d(std::cos(yaw), std::sin(yaw));
    if (i < 12) speed -= 0.7;  // 7 m/s^2
    if (i > 15 && i < 45) yaw += 0.06;
  }
}

TEST(Tracker, MovesWhatItFollowsIntoTheFixedFrameWhenPosesCome) {
  Tracker tracker;
  std::vector<Tracker::Assignment> found;
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() << 1000, -2000, 5;
  for (int i = 0; i < 8; ++i) {
    tracker.update(i * 100'000'000LL, {box(10 + 0.5 * i, 3)}, {}, found,
                   i < 4 || i == 6 ? std::nullopt : std::optional(pose));
    if (i < 2) continue;
    ASSERT_EQ(id_of(found[0]), 0U) << i;
    const Eigen::Vector3d along(5, 0, 0);
    const Eigen::Vector3d expected = i < 4 || i == 6 ? along : Eigen::Vector3d(pose.linear() * along);
    EXPECT_LT((found[0].track->velocity - expected).norm(), 1e-6) << i;
  }
}

TEST(BoxGrid, LooksAtFewOfManyBoxesInARowAndAtAllThatAreNear) {
  for (const Eigen::Vector3d& step : {Eigen::Vector3d(1, 0, 0), {0, 1, 0}, {-0.7, 0.7, 0}}) {
    std::vector<Aabb> boxes;
    for (int i = -1000; i < 1000; ++i)
      boxes.push_back(Aabb(i * step, i * step));
    BoxGrid grid;
    grid.fill(boxes, 4);
    for (const int at : {-1000, -3, 0, 500, 999}) {
      std::set<std::size_t> near;
      grid.visit_near(at * step, [&](std::size_t b) { EXPECT_TRUE(near.insert(b).second); });
      EXPECT_LE(near.size(), 18U);
      for (std::size_t b = 0; b < boxes.size(); ++b) {
        if ((boxes[b].center() - at * step).norm() > 4) continue;
        EXPECT_EQ(near.count(b), 1U) << at << ' ' << b;
      }
    }
  }
}

TEST(Tracker, ManyObjectsKeepTheirIds) {
  std::vector<Aabb> boxes;
  for (int i = 0; i < 20'000; ++i)
    boxes.push_back(box(0, 5.0 * i));
  Tracker tracker;
  for (int i = 0; i < 3; ++i)
    update(tracker, i, boxes);
  const auto found = update(tracker, 3, boxes);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    ASSERT_EQ(id_of(found[i]), i);
}

// Two parts, the younger one nearer to the whole.
TEST(Tracker, TheOldestOfTheTracksOfPartsGetsTheWhole) {
  const auto part = [](double low, double high) {
    return Aabb(Eigen::Vector3d(low, 0, 0), Eigen::Vector3d(high, 1.6, 1));
  };
  Tracker tracker;
  std::optional<std::uint32_t> id;
  for (int i = 0; i < 12; ++i) {
    std::vector<Aabb> boxes{part(0, 0.8)};
    if (i >= 8) boxes.push_back(part(1.2, 2.2));
    id = id_of(update(tracker, i, boxes)[0]);
  }
  const auto whole = update(tracker, 12, {part(0, 2.2)});
  ASSERT_TRUE(id);
  EXPECT_EQ(id_of(whole[0]), id);
}

// Before there are enough sightings, a fast object moves; one that stands is reported as slow.
TEST(Tracker, MovingAndTheVelocityDoNotContradictEachOther) {
  TrackConfig config;
  config.birth = 1;
  Tracker tracker;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> jump(-0.4, 0.4);
  for (int i = 0; i < 40; ++i) {
    const Aabb still = box(jump(random), jump(random));
    const Eigen::Vector3d height(0, 0, jump(random));
    const auto found =
        update(tracker, i, {Aabb(still.min() + height, still.max() + height), box(50 + i, 0)}, config);
    for (const Tracker::Assignment& each : found) {
      ASSERT_TRUE(each.track);
      EXPECT_TRUE(each.track->moving || each.track->velocity.norm() <= 1) << i;
    }
    if (i > 0) {
      EXPECT_TRUE(found[1].track->moving) << i;
    }
  }
}

TEST(Tracker, ASplitObjectKeepsItsIdOnTheGreaterPart) {
  Tracker tracker;
  for (int i = 0; i < 4; ++i)
    update(tracker, i, {box(0, 0, 4)});
  const auto found = update(tracker, 4, {box(0.5, 0, 3), box(-1.5, 0, 0.5)});
  EXPECT_EQ(id_of(found[0]), 0U);
  EXPECT_TRUE(found[1].fresh);
}

// The true object of most of a cluster's points.
std::uint32_t object_of(const FrameResult& result, std::size_t cluster, const SynthCloud& cloud) {
  std::map<std::uint32_t, std::size_t> votes;
  for (std::size_t i = 0; i < result.clusters.list_size(cluster); ++i)
    ++votes[cloud.object[static_cast<std::size_t>(result.clusters.list(cluster)[i])]];
  const auto most = std::max_element(votes.begin(), votes.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return 2 * most->second > result.clusters.list_size(cluster) ? most->first : 0;
}

// One object, one id, over the frames in which it is seen; cars, pedestrians and poles, as they are one
// cluster each.
TEST(Tracking, OfTheStreetKeepsOneIdPerObject) {
  PipelineConfig config;
  config.volumes = {"aabb"};
  config.track.enabled = true;
  for (const std::uint64_t seed : {1, 2}) {
    FramePipeline pipeline(config);
    FrameResult result;
    std::map<std::uint32_t, std::map<std::uint32_t, std::size_t>> ids;  // object, id, frames
    for (std::size_t i = 0; i < 22; ++i) {
      StreetOptions options;
      options.seed = seed;
      const StreetFrame street = make_street_frame(options, i);
      std::map<std::uint32_t, SynthObjectKind> kinds;
      for (const StreetObject& object : street.objects)
        kinds[object.id] = object.kind;
      Frame frame;
      frame.header.stamp_ns = static_cast<std::int64_t>(i) * 100'000'000;
      frame.points = PointView::of(street.cloud.xyz.data(), 12, street.cloud.size());
      pipeline.process(frame, result);
      std::set<std::uint32_t> seen;
      for (std::size_t c = 0; c < result.clusters.size(); ++c) {
        const std::uint32_t object = object_of(result, c, street.cloud);
        const auto kind = kinds.find(object);
        if (kind == kinds.end() || kind->second > SynthObjectKind::pole) continue;
        if (!result.tracks[c] || !seen.insert(object).second) continue;  // its largest part counts
        ++ids[object][result.tracks[c]->id];
      }
    }
    std::size_t frames = 0, stable = 0;
    for (const auto& [object, counts] : ids) {
      std::size_t most = 0;
      for (const auto& [id, n] : counts) {
        frames += n;
        most = std::max(most, n);
      }
      stable += most;
    }
    const double part = static_cast<double>(stable) / static_cast<double>(frames);
    RecordProperty("stable", std::to_string(part));
    std::printf("seed %d: %zu objects, %zu sightings, %.1f %% by one id\n", static_cast<int>(seed),
                ids.size(), frames, 100 * part);
    EXPECT_GE(ids.size(), 20U);
    EXPECT_GE(part, 0.95) << "seed " << seed;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
