// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/synth/rural_road.h"
#include "pipeline/refine/cluster_refiner.h"

namespace pcl_bv::detail {
namespace {

using Box = Eigen::AlignedBox3d;

Box box_at(double x, double y, double length, double width, double height) {
  return {Eigen::Vector3d(x - length / 2, y - width / 2, 0),
          Eigen::Vector3d(x + length / 2, y + width / 2, height)};
}

KnownObject object_at(const Box& box, std::size_t whole = 10) {
  KnownObject object;
  object.box = box;
  object.detections = object.whole = whole;
  object.has_id = true;
  return object;
}

// Points on the faces of a box.
void add_faces(std::vector<Eigen::Vector3d>& points, const Box& box, std::size_t count,
               std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d share(unit(random), unit(random), unit(random));
    share[static_cast<Eigen::Index>(random() % 3)] = static_cast<double>(random() % 2);
    points.push_back(box.min() + share.cwiseProduct(box.sizes()));
  }
}

Box box_of(const std::vector<Eigen::Vector3d>& points) {
  Box box;
  for (const Eigen::Vector3d& point : points)
    box.extend(point);
  return box;
}

struct Scene {  // a car, and a person 0.35 m beside it
  std::vector<Eigen::Vector3d> points;
  Box car = box_at(10, 0, 4.4, 1.8, 1.5), person = box_at(10.4, 1.5, 0.5, 0.5, 1.7);
  std::size_t car_points = 300;

  explicit Scene(std::size_t person_points = 40) {
    std::mt19937_64 random(7);
    add_faces(points, car, car_points, random);
    add_faces(points, person, person_points, random);
  }
};

std::size_t cut(const Scene& scene, const std::vector<KnownObject>& known,
                std::vector<std::uint32_t>& part_of) {
  TrackCut tracks;
  return tracks.find(scene.points, box_of(scene.points), known, 0.07, 10, part_of);
}

TEST(TrackCut, SeparatesAnExpectedPersonFromACar) {
  const Scene scene;
  std::vector<std::uint32_t> part_of;
  ASSERT_EQ(cut(scene, {object_at(scene.car), object_at(scene.person)}, part_of), 2U);
  for (std::size_t i = 0; i < part_of.size(); ++i)
    EXPECT_EQ(part_of[i], i < scene.car_points ? 1U : 0U) << i;
}

TEST(TrackCut, SeparatesNoPersonWhoIsNotExpectedOrWasAlwaysAPart) {
  const Scene scene;
  std::vector<std::uint32_t> part_of;
  EXPECT_LT(cut(scene, {}, part_of), 2U);
  EXPECT_LT(cut(scene, {object_at(scene.car)}, part_of), 2U);
  EXPECT_LT(cut(scene, {object_at(scene.car), object_at(scene.person, 0)}, part_of), 2U);
  KnownObject cut_for_long = object_at(scene.person);
  cut_for_long.cut = 61;
  EXPECT_LT(cut(scene, {object_at(scene.car), cut_for_long}, part_of), 2U);
  const Box far = box_at(10.4, 5, 0.5, 0.5, 1.7);
  EXPECT_LT(cut(scene, {object_at(scene.car), object_at(far)}, part_of), 2U);
}

TEST(TrackCut, LeavesAPersonOfAFewPointsInTheCluster) {
  const Scene scene(7);
  std::vector<std::uint32_t> part_of;
  EXPECT_LT(cut(scene, {object_at(scene.car), object_at(scene.person)}, part_of), 2U);
}

std::vector<ClusterPart> pieces_of(const std::vector<Box>& boxes) {
  std::vector<ClusterPart> pieces;
  for (const Box& box : boxes)
    pieces.push_back({0, 10, pieces.size(), Refinement::none, box});
  return pieces;
}

// The front and the back of a car, 1.4 m apart, and a person beside it.
const Box kCar = box_at(20, 0, 4.4, 1.8, 1.5), kFront = box_at(21.7, 0, 1, 1.7, 0.8),
          kBack = box_at(18.5, 0, 1.4, 1.7, 1.4), kPerson = box_at(20, 0.6, 0.5, 0.5, 1.5);

TEST(PartJoin, JoinsThePartsOfAKnownCar) {
  PartJoin join;
  std::vector<std::size_t> whole_of;
  const std::vector<ClusterPart> pieces = pieces_of({box_at(50, 0, 1, 1, 1), kFront, kBack});
  EXPECT_EQ(join.find(pieces, {}, {}, whole_of), 0U);
  EXPECT_EQ(join.find(pieces, {object_at(kCar)}, {}, whole_of), 1U);
  EXPECT_EQ(whole_of, (std::vector<std::size_t>{PartJoin::none, PartJoin::none, 1}));
}

TEST(PartJoin, TheLargestOfNestedTracksGetsTheParts) {
  PartJoin join;
  std::vector<std::size_t> whole_of;
  const std::vector<ClusterPart> pieces =
      pieces_of({kFront, box_at(18.1, 0, 0.5, 1.7, 0.5), box_at(18.9, 0, 0.5, 1.7, 1.4)});
  std::vector<KnownObject> known{object_at(box_at(18.5, 0, 1.6, 1.8, 1.5)), object_at(kCar)};
  EXPECT_EQ(join.find(pieces, known, {}, whole_of), 1U);
  EXPECT_EQ(whole_of, (std::vector<std::size_t>{PartJoin::none, 0, 0}));
}

TEST(PartJoin, LeavesPeopleOtherClassesPartsThatWereCutAndLargeObjectsApart) {
  PartJoin join;
  std::vector<std::size_t> whole_of;
  std::vector<KnownObject> known{object_at(kCar), object_at(kPerson)};
  std::sort(known.begin(), known.end(), [](const KnownObject& a, const KnownObject& b) {
    return a.box.center().x() < b.box.center().x();
  });
  EXPECT_EQ(join.find(pieces_of({kFront, kPerson}), known, {}, whole_of), 0U);
  EXPECT_EQ(join.find(pieces_of({kFront, kPerson}), {object_at(kCar)}, {}, whole_of), 1U);  // not known
  EXPECT_EQ(join.find(pieces_of({kFront, kBack}), {object_at(kCar)}, {1, 2}, whole_of), 0U);
  EXPECT_EQ(join.find(pieces_of({kFront, kBack}), {object_at(kCar)}, {2, 2}, whole_of), 1U);
  std::vector<ClusterPart> pieces = pieces_of({kFront, kBack});
  pieces[1].refinement = Refinement::cut;
  EXPECT_EQ(join.find(pieces, {object_at(kCar)}, {}, whole_of), 0U);
  EXPECT_EQ(join.find(pieces_of({kFront, kBack}), {object_at(box_at(20, 0, 6.1, 1.8, 1.5))}, {}, whole_of),
            0U);
  EXPECT_EQ(join.find(pieces_of({kFront, kBack}), {object_at(box_at(20, 0, 5.9, 1.8, 1.5))}, {}, whole_of),
            1U);
}

TEST(KnownObject, FollowsFacesGrowsAtOnceAndShrinksSlowly) {
  KnownObject object;
  object.add(box_at(0, 0, 4, 2, 1.5), Refinement::none);
  EXPECT_TRUE(object.box.isApprox(box_at(0, 0, 4, 2, 1.5)));
  object.add(box_at(1, 0, 4, 2, 1.5), Refinement::none);
  EXPECT_TRUE(object.box.isApprox(box_at(1, 0, 4, 2, 1.5)));
  object.add(box_at(1, 0, 5, 2, 1.5), Refinement::cut);
  EXPECT_TRUE(object.box.isApprox(box_at(1, 0, 5, 2, 1.5)));
  object.add(box_at(1, 0, 3, 2, 1.5), Refinement::cut);
  EXPECT_TRUE(object.box.isApprox(box_at(1, 0, 5 - 0.03 * 2, 2, 1.5)));
  EXPECT_EQ(object.whole, 2U);
  EXPECT_EQ(object.cut, 2U);
  object.add(object.box, Refinement::joined);
  EXPECT_EQ(object.cut, 0U);
}

// Runs a road with tracking; calls check(frame, off, tracks) with the results without and with refinement.
template <typename Check>
void run_road(std::size_t frames, unsigned threads, const Check& check) {
  PipelineConfig config;
  apply_preset("road", config);
  config.volumes = {"aabb"};
  config.threads = threads;
  config.track.enabled = true;
  FramePipeline tracks(config);
  config.cluster.refine = Refine::off;
  FramePipeline off(config);
  FrameResult with, without;
  for (std::size_t number = 0; number < frames; ++number) {
    const RuralRoadFrame made = make_rural_road_frame({2, 64}, number);
    Frame frame;
    frame.header.stamp_ns = static_cast<std::int64_t>(number) * 100'000'000;
    frame.points = PointView::of(made.cloud.xyz.data(), 3 * sizeof(float), made.cloud.size());
    Pose pose = Pose::Identity();
    for (std::size_t i = 0; i < made.pose.size(); ++i)
      pose.matrix()(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) = made.pose[i];
    frame.pose = pose;
    off.process(frame, without);
    tracks.process(frame, with);
    check(frame, without, with);
  }
}

// The whole cloud is one object without an index list. Its points may be invalid, and more than 32 768 points
// are filtered when they are loaded.
TEST(TrackedPeople, AreTrackedWithoutClustersWithInvalidAndFilteredPoints) {
  for (const std::size_t count : {500, 40'000}) {
    PipelineConfig config;
    config.volumes = {"aabb"};
    config.ground.method = GroundMethod::none;
    config.cluster.tolerance = 0;
    config.filter.range_min = count == 500 ? 0 : 1;
    config.track.enabled = true;
    FramePipeline pipeline(config);
    FrameResult result;
    std::mt19937_64 random(12);
    std::vector<Eigen::Vector3d> points;
    add_faces(points, box_at(8, 3, 0.3, 0.4, 1.7), count, random);
    points[7].x() = std::numeric_limits<double>::quiet_NaN();
    if (count != 500) points[8].setConstant(0.1);  // below range_min
    for (int i = 0; i < 4; ++i) {
      Frame frame;
      frame.header.stamp_ns = i * 100'000'000LL;
      frame.points = PointView::of(points.data()->data(), sizeof(Eigen::Vector3d), points.size());
      pipeline.process(frame, result);
    }
    ASSERT_EQ(result.tracks.size(), 1U);
    ASSERT_TRUE(result.tracks[0]) << count;
    EXPECT_NEAR(result.tracks[0]->pose[0], 8, 0.02);
    EXPECT_NEAR(result.tracks[0]->pose[1], 3, 0.02);
  }
}

// A person who stands still stretches out the left arm and the right arm in turn.
TEST(TrackedPeople, StandWhateverTheirArmsDo) {
  PipelineConfig config;
  config.volumes = {"aabb"};
  config.ground.method = GroundMethod::none;
  config.track.enabled = true;
  FramePipeline pipeline(config);
  FrameResult result;
  for (int i = 0; i < 30; ++i) {
    std::mt19937_64 random(11);
    std::vector<Eigen::Vector3d> points;
    add_faces(points, box_at(8, 3, 0.3, 0.4, 1.7), 400, random);
    const double side = i / 4 % 2 == 0 ? 1 : -1;
    const Eigen::Vector3d hand(8, 3 + 0.7 * side, 1.4), shoulder(8, 3 + 0.2 * side, 1.4);
    for (int k = 0; k <= 20; ++k)
      points.push_back(shoulder + k / 20.0 * (hand - shoulder));
    Frame frame;
    frame.header.stamp_ns = i * 100'000'000LL;
    frame.pose = Pose::Identity();
    frame.points = PointView::of(points.data()->data(), sizeof(Eigen::Vector3d), points.size());
    pipeline.process(frame, result);
    ASSERT_EQ(result.tracks.size(), 1U);
    if (!result.tracks[0]) continue;
    EXPECT_LT(result.tracks[0]->velocity.norm(), 0.25) << i;
    EXPECT_NEAR(result.tracks[0]->pose[1], 3, 0.06) << i;
  }
}

TEST(RefineByTracks, KeepsEveryPointInOneObjectAndTheOrderOfClusters) {
  std::size_t cut = 0, joined = 0;
  run_road(12, 1, [&](const Frame&, const FrameResult& without, const FrameResult& with) {
    const Clusters& a = without.clusters;
    const Clusters& b = with.clusters;
    EXPECT_EQ(std::multiset<std::int32_t>(a.indices.begin(), a.indices.end()),
              std::multiset<std::int32_t>(b.indices.begin(), b.indices.end()));
    ASSERT_EQ(with.refinements.size(), b.size());
    ASSERT_EQ(with.tracks.size(), b.size());
    for (std::size_t i = 0; i < b.size(); ++i) {
      EXPECT_TRUE(std::is_sorted(b.list(i), b.list(i) + b.list_size(i)));
      EXPECT_TRUE(i == 0 || b.list_size(i - 1) >= b.list_size(i));
    }
    EXPECT_EQ(with.counts.joined, static_cast<std::size_t>(std::count(
                                      with.refinements.begin(), with.refinements.end(), Refinement::joined)));
    EXPECT_TRUE(without.refinements.empty());
    cut += with.counts.cut;
    joined += with.counts.joined;
  });
  EXPECT_GT(cut, 10U);
  EXPECT_GT(joined, 3U);
}

TEST(RefineByTracks, GivesTheSameObjectsWithAnyNumberOfThreads) {
  std::vector<std::vector<std::int32_t>> indices;
  run_road(5, 1, [&](const Frame&, const FrameResult&, const FrameResult& with) {
    indices.push_back(with.clusters.indices);
  });
  std::size_t number = 0;
  run_road(5, 3, [&](const Frame&, const FrameResult&, const FrameResult& with) {
    EXPECT_EQ(with.clusters.indices, indices[number]) << number;
    ++number;
  });
}

TEST(RefineByTracks, ReportsNoObjectThatStandsAndIsFasterThanOneMetreASecond) {
  std::size_t standing = 0;
  run_road(12, 1, [&](const Frame&, const FrameResult&, const FrameResult& with) {
    for (const std::optional<TrackEntry>& track : with.tracks) {
      if (!track || track->moving) continue;
      EXPECT_LE(track->velocity.head<2>().norm(), 1 + 1e-9);
      ++standing;
    }
  });
  EXPECT_GT(standing, 100U);
}

}  // namespace
}  // namespace pcl_bv::detail
