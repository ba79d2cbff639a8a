// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// association_scores: scores of association alone. The same detections go to pcl_bv's tracker and to a usual
// one (docs/scores.md).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "baseline_tracker.h"
#include "detections.h"
#include "kitti_score.h"
#include "pipeline/track/tracker.h"
#include "score_program.h"
#include "track_score.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

constexpr const char* kUsage =
    "usage: association_scores synth [SEEDS [FRAMES [FIRST_SEED]]]\n"
    "       association_scores kitti DETECTIONS.txt LABELS.txt CALIBRATION.txt [CLASS [MIN_SCORE]]\n";

using Ids = std::vector<std::optional<std::uint32_t>>;

// One tracker with one setting, and what came of it.
struct Contest {
  Contest(std::string row, bool own_tracker, bool with_poses, std::size_t deletion)
      : name(std::move(row)), own(own_tracker), poses(with_poses), death(deletion) {
    restart();
  }

  void restart() {
    tracker = Tracker();
    baseline = BaselineTracker({3, death, 0.01});
  }

  // `boxes` are in the sensor's frame.
  Ids update(std::size_t frame, const std::vector<DetectedBox>& boxes, const Pose& pose);

  std::string name;
  bool own, poses;
  std::size_t death;
  Tracker tracker;
  BaselineTracker baseline{BaselineTracker::Options()};
  TrackScore score;
  double seconds = 0;
  std::size_t frames = 0;
};

// The box along the axes of the sensor's frame, which is what the tracker takes.
Aabb bounds_of(const DetectedBox& box) {
  const double c = std::abs(std::cos(box.base.yaw)), s = std::abs(std::sin(box.base.yaw));
  const Eigen::Vector2d half(c * box.base.length + s * box.base.width,
                             s * box.base.length + c * box.base.width);
  const Eigen::Vector2d low = box.base.center - half / 2, high = box.base.center + half / 2;
  return {{low.x(), low.y(), box.low}, {high.x(), high.y(), box.high}};
}

DetectedBox moved(const DetectedBox& box, const Pose& pose) {
  const double height = box.high - box.low;
  const Eigen::Vector3d middle =
      pose * Eigen::Vector3d(box.base.center.x(), box.base.center.y(), (box.low + box.high) / 2);
  const Eigen::Vector3d along =
      pose.linear() * Eigen::Vector3d(std::cos(box.base.yaw), std::sin(box.base.yaw), 0);
  return {{middle.head<2>(), std::atan2(along.y(), along.x()), box.base.length, box.base.width},
          middle.z() - height / 2,
          middle.z() + height / 2};
}

Ids Contest::update(std::size_t frame, const std::vector<DetectedBox>& boxes, const Pose& pose) {
  const std::clock_t begin = std::clock();  // of the processor: other programs do not count
  Ids ids(boxes.size());
  if (own) {
    TrackConfig config;
    config.death = death;
    std::vector<Aabb> bounds;
    for (const DetectedBox& box : boxes)
      bounds.push_back(bounds_of(box));
    std::vector<Tracker::Assignment> assignments;
    tracker.update(static_cast<std::int64_t>(frame) * 100'000'000, bounds, config, assignments,
                   poses ? std::optional(pose) : std::nullopt);
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (assignments[i].track) ids[i] = assignments[i].track->id;
  } else {
    std::vector<DetectedBox> fixed;
    for (const DetectedBox& box : boxes)
      fixed.push_back(poses ? moved(box, pose) : box);
    ids = baseline.update(fixed);
  }
  seconds += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  ++frames;
  return ids;
}

std::vector<Contest> contests(bool with_poses) {
  std::vector<Contest> all;
  for (const bool poses : {true, false}) {
    if (poses && !with_poses) continue;
    const std::string end = poses ? ", poses" : ", no poses";
    for (const std::size_t death : {std::size_t{5}, std::size_t{2}}) {
      all.emplace_back("pcl_bv, death " + std::to_string(death) + end, true, poses, death);
      all.emplace_back("as AB3DMOT, death " + std::to_string(death) + end, false, poses, death);
    }
  }
  return all;
}

void print(const std::vector<Contest>& all) {
  std::puts(
      "| tracker | HOTA | DetA | AssA | MOTA | switches | fragmentations | objects | ms a frame |\n"
      "|---|---|---|---|---|---|---|---|---|");
  for (const Contest& contest : all) {
    const TrackScores s = contest.score.result();
    std::printf("| %s | %.1f | %.1f | %.1f | %.1f | %zu | %zu | %zu | %.3f |\n", contest.name.c_str(),
                100 * s.hota, 100 * s.detection, 100 * s.association, 100 * s.mota, s.switches, s.fragments,
                s.truths,
                1000 * contest.seconds / static_cast<double>(std::max<std::size_t>(1, contest.frames)));
  }
}

Pose pose_of(const std::array<double, 12>& rows) {
  Pose pose = Pose::Identity();
  for (Eigen::Index r = 0; r < 3; ++r)
    for (Eigen::Index c = 0; c < 4; ++c)
      pose.matrix()(r, c) = rows[static_cast<std::size_t>(4 * r + c)];
  return pose;
}

std::vector<RuralRoadObject> objects_within(const RuralRoadFrame& made, double range, bool only_cars) {
  std::vector<RuralRoadObject> objects;
  for (const RuralRoadObject& object : made.objects) {
    const bool kind =
        object.kind == SynthObjectKind::car ||
        (!only_cars && (object.kind == SynthObjectKind::pedestrian ||
                        object.kind == SynthObjectKind::cyclist || object.kind == SynthObjectKind::pole));
    if (kind && std::hypot(object.center[0], object.center[1]) < range) objects.push_back(object);
  }
  return objects;
}

// A detection matches its source, whatever its box. So HOTA and MOTA depend on association alone.
void add_frame(Contest& contest, const std::vector<RuralRoadObject>& objects,
               const std::vector<Detection>& detections, const Ids& ids) {
  std::vector<std::uint32_t> truths, tracks;
  std::vector<SimilarPair> pairs;
  for (const RuralRoadObject& object : objects)
    truths.push_back(object.id);
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (!ids[d]) continue;
    for (std::size_t t = 0; t < truths.size(); ++t)
      if (detections[d].object == truths[t]) pairs.push_back({t, tracks.size(), 1});
    tracks.push_back(*ids[d]);
  }
  contest.score.add(truths, tracks, pairs, 0.5);
}

void run_synth(std::size_t seeds, std::size_t frames, std::size_t first) {
  for (const bool only_cars : {true, false}) {
    std::vector<Contest> all = contests(true);
    const DetectorErrors errors;
    for (std::size_t seed = first; seed < first + seeds; ++seed) {
      Detector detector(errors, seed);
      for (Contest& contest : all) {
        contest.restart();
        contest.score.start_sequence();
      }
      for (std::size_t number = 0; number < frames; ++number) {
        const RuralRoadFrame made = make_rural_road_truth({seed, 64}, number);
        const std::vector<RuralRoadObject> objects = objects_within(made, errors.range, only_cars);
        const std::vector<Detection> detections = detector.detect(objects);
        std::vector<DetectedBox> boxes;
        for (const Detection& detection : detections)
          boxes.push_back(detection.box);
        for (Contest& contest : all)
          add_frame(contest, objects, detections, contest.update(number, boxes, pose_of(made.pose)));
      }
    }
    std::printf("%sDetections of %s, synth:rural-road-sequence, %zu seeds of %zu frames\n",
                only_cars ? "" : "\n", only_cars ? "cars" : "cars, people, cyclists and poles", seeds,
                frames);
    print(all);
  }
}

void run_kitti(const std::vector<std::string>& words) {
  const KittiCalibration calibration(words[2]);
  KittiProtocol protocol;
  protocol.classes = {words.size() > 3 ? words[3] : "Car"};
  protocol.count_unlabelled = true;  // detectors name a class, so a box elsewhere is wrong
  const double min_score = words.size() > 4 ? std::stod(words[4]) : -1e9;
  const std::vector<KittiObject> labels = read_kitti_labels(words[1], calibration);
  std::vector<std::vector<DetectedBox>> boxes;
  for (const KittiDetection& detection : read_kitti_detections(words[0], calibration)) {
    if (protocol.classes.count(detection.type) == 0 || detection.score < min_score) continue;
    boxes.resize(std::max(boxes.size(), detection.frame + 1));
    boxes[detection.frame].push_back({detection.base, detection.low, detection.high});
  }
  std::vector<Contest> all = contests(false);
  for (Contest& contest : all) {
    std::vector<ResultFrame> results;
    for (std::size_t number = 0; number < boxes.size(); ++number) {
      const Ids ids = contest.update(number, boxes[number], Pose::Identity());
      ResultFrame& frame = results.emplace_back();
      frame.number = number;
      for (std::size_t i = 0; i < ids.size(); ++i)
        if (ids[i])
          frame.boxes.push_back(
              {*ids[i], boxes[number][i].base, boxes[number][i].low, boxes[number][i].high});
    }
    add_kitti_sequence(labels, calibration, results, protocol, contest.score);
  }
  std::printf("Detections of KITTI, %s, bird's-eye IoU >= %g for MOTA\n", protocol.classes.begin()->c_str(),
              protocol.min_iou);
  print(all);
}

std::size_t count_of(const std::vector<std::string>& words, std::size_t i, std::size_t otherwise) {
  if (words.size() <= i) return otherwise;
  if (words[i].empty() || words[i].size() > 6 ||
      words[i].find_first_not_of("0123456789") != std::string::npos)
    throw UsageError("'" + words[i] + "' is not a whole number below 1000000");
  return std::stoul(words[i]);
}

int run(int argc, char** argv) {
  const std::string kind = argc > 1 ? argv[1] : "synth";
  const std::vector<std::string> words(argv + std::min(argc, 2), argv + argc);
  if (kind == "--help") {
    std::fputs(kUsage, stdout);
  } else if (kind == "synth" && words.size() <= 3) {
    run_synth(count_of(words, 0, 3), count_of(words, 1, 300), count_of(words, 2, 1));
  } else if (kind == "kitti" && words.size() >= 3 && words.size() <= 5) {
    run_kitti(words);
  } else {
    throw UsageError("wrong arguments; see association_scores --help");
  }
  return 0;
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  return pcl_bv::bench::run_scores("association_scores", [&] { return pcl_bv::bench::run(argc, argv); });
}
