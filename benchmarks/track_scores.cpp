// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// track_scores [SEEDS [FRAMES [BEAMS [FIRST [off|neck|tracks]]]]]: scores of tracking cars, people, cyclists
// and poles of synth:rural-road-sequence: FRAMES (300) frames of each of SEEDS (3) seeds from FIRST (1) on,
// with this refinement (tracks), with and without poses, with unchanged and stabilised boxes.
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "motion_score.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/synth/rural_road.h"
#include "pipeline/config/settings.h"
#include "track_score.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

constexpr std::size_t kLeast = 10;  // points of an object that is asked for

bool asked_for(SynthObjectKind kind) {
  return kind == SynthObjectKind::car || kind == SynthObjectKind::pedestrian ||
         kind == SynthObjectKind::cyclist || kind == SynthObjectKind::pole;
}

Pose pose_of(const std::array<double, 12>& rows) {
  Pose pose = Pose::Identity();
  for (Eigen::Index r = 0; r < 3; ++r)
    for (Eigen::Index c = 0; c < 4; ++c)
      pose.matrix()(r, c) = rows[static_cast<std::size_t>(4 * r + c)];
  return pose;
}

PipelineConfig config_of(bool steady, Refine refine) {
  PipelineConfig config;
  apply_preset("road", config);
  config.volumes = {"obb-lshape"};
  config.cluster.refine = refine;
  config.track.enabled = true;
  config.track.smooth = config.track.grow = steady;
  return config;
}

// One way to run the pipeline, and what came of it.
struct Contest {
  Contest(const char* row, bool with_poses, const PipelineConfig& settings)
      : name(row), poses(with_poses), config(settings), pipeline(settings) {}

  const char* name;
  bool poses;
  PipelineConfig config;
  FramePipeline pipeline;
  FrameResult result;
  TrackScore tracks;
  MotionScore motion;
  double milliseconds = 0;
  std::size_t frames = 0;
};

// The objects that are asked for, and their places in the lists.
struct Truth {
  std::vector<TrueObject> objects;
  std::vector<const RuralRoadObject*> full;
  std::map<std::uint32_t, std::size_t> place;

  explicit Truth(const RuralRoadFrame& made) {
    std::map<std::uint32_t, std::size_t> points;
    for (const std::uint32_t id : made.cloud.object)
      ++points[id];
    for (const RuralRoadObject& object : made.objects) {
      if (!asked_for(object.kind) || points[object.id] < kLeast) continue;
      place[object.id] = objects.size();
      objects.push_back({object.id, points[object.id]});
      full.push_back(&object);
    }
  }
};

std::vector<FoundObject> found_in(const FrameResult& result, const RuralRoadFrame& made, const Truth& truth,
                                  std::vector<std::size_t>& clusters) {
  std::vector<FoundObject> found;
  clusters.clear();
  for (std::size_t c = 0; c < result.clusters.size(); ++c) {
    if (!result.tracks[c]) continue;
    FoundObject object{result.tracks[c]->id, result.clusters.list_size(c), {}, false};
    std::map<std::size_t, std::size_t> shared;
    for (std::size_t i = 0; i < object.points; ++i) {
      const auto at =
          truth.place.find(made.cloud.object[static_cast<std::size_t>(result.clusters.list(c)[i])]);
      if (at != truth.place.end()) ++shared[at->second];
    }
    std::size_t asked = 0;
    for (const auto& [place, points] : shared)
      asked += points;
    object.shared.assign(shared.begin(), shared.end());
    object.other = 2 * asked <= object.points;
    found.push_back(object);
    clusters.push_back(c);
  }
  return found;
}

MotionSighting sighting_of(const Contest& contest, std::size_t cluster, const RuralRoadObject& object,
                           const Pose& pose) {
  const TrackEntry& track = *contest.result.tracks[cluster];
  MotionSighting sighting;
  sighting.object = object.id;
  sighting.track = track.id;
  sighting.true_velocity = Eigen::Map<const Eigen::Vector3d>(object.velocity.data());
  sighting.velocity = track.velocity;
  sighting.moving = track.moving;
  sighting.range = std::hypot(object.center[0], object.center[1]);
  const Obb* const box = std::get_if<Obb>(&contest.result.volume(cluster, 0));
  if (object.kind != SynthObjectKind::car || box == nullptr || box->empty()) return sighting;
  const Eigen::Vector3d front = pose.linear() * box->axis(0),
                        forward = pose.linear() * Eigen::Map<const Eigen::Vector3d>(object.axes[0].data());
  sighting.turn = std::atan2(front.y(), front.x()) - std::atan2(forward.y(), forward.x());
  sighting.length = 2 * box->half_extents().x();
  return sighting;
}

void run_frame(Contest& contest, const RuralRoadFrame& made, std::size_t number, const Truth& truth) {
  Frame frame;
  frame.header.stamp_ns = static_cast<std::int64_t>(number) * 100'000'000;
  frame.points = PointView::of(made.cloud.xyz.data(), 3 * sizeof(float), made.cloud.size());
  const Pose pose = pose_of(made.pose);
  if (contest.poses) frame.pose = pose;
  contest.pipeline.process(frame, contest.result);
  contest.milliseconds += contest.result.ms.track;
  ++contest.frames;
  std::vector<std::size_t> clusters;
  const std::vector<FoundObject> found = found_in(contest.result, made, truth, clusters);
  for (const auto& [t, f] : contest.tracks.add(truth.objects, found))
    contest.motion.add(sighting_of(contest, clusters[f], *truth.full[t], pose));
}

void print(const Contest& contest) {
  const TrackScores scores = contest.tracks.result();
  const MotionScore& motion = contest.motion;
  const double thousands = static_cast<double>(scores.matches) / 1000;
  std::printf("%-18s %6zu %5.1f %5.1f %5.1f  %6.2f  %6.3f %5.1f %5.1f", contest.name, scores.truths,
              100 * scores.mota, 100 * scores.hota, 100 * scores.association,
              static_cast<double>(scores.switches) / thousands,
              static_cast<double>(scores.wrong) / thousands / 10,
              100 * static_cast<double>(scores.matches) / static_cast<double>(scores.truths),
              100 * static_cast<double>(scores.fragments) / static_cast<double>(scores.matches));
  if (contest.poses) {
    std::printf("  %5.2f %5.2f %5.1f %5.1f", motion.velocity_error(0.5), motion.velocity_error(0.95),
                100 * motion.standing_right(), 100 * motion.moving_right());
  } else {
    std::printf("  %5s %5s %5.1f %5.1f", "", "", 100 * motion.standing_right(), 100 * motion.moving_right());
  }
  std::printf("  %3zu/%zu %5.1f %5.1f %5.2f %5.2f  %5.2f\n", motion.flips(), motion.boxes(),
              motion.turn_jitter(0.5), motion.turn_jitter(0.95), motion.length_jitter(0.5),
              motion.length_jitter(0.95), contest.milliseconds / static_cast<double>(contest.frames));
}

int run(int argc, char** argv) {
  const auto argument = [&](int i, std::size_t otherwise) {
    return argc > i ? static_cast<std::size_t>(std::stoull(argv[i])) : otherwise;
  };
  Refine refine = Refine::tracks;
  if (argc > 5) read_text(argv[5], refine);
  std::vector<Contest> contests;
  for (const bool poses : {true, false}) {
    contests.emplace_back(poses ? "poses" : "no poses", poses, config_of(false, refine));
    contests.emplace_back(poses ? "poses, steady" : "no poses, steady", poses, config_of(true, refine));
  }
  const std::size_t first = argument(4, 1);
  for (std::size_t seed = first; seed < first + argument(1, 3); ++seed) {
    for (Contest& contest : contests) {
      contest.pipeline = FramePipeline(contest.config);
      contest.tracks.start_sequence();
      contest.motion.start_sequence();
    }
    for (std::size_t number = 0; number < argument(2, 300); ++number) {
      const RuralRoadFrame made = make_rural_road_frame({seed, argument(3, 64)}, number);
      const Truth truth(made);
      for (Contest& contest : contests)
        run_frame(contest, made, number, truth);
    }
  }
  std::puts(
      "%                   truths  MOTA  HOTA  AssA  sw/1000  wrong found  frag  m/s    p95   stand move  "
      "flips"
      "   turn   p95   len   p95   ms");
  for (const Contest& contest : contests)
    print(contest);
  return 0;
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  try {
    return pcl_bv::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "track_scores: %s\n", error.what());
    return 2;
  }
}
