// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tracking predicts the tracks, selects plausible pairs of a track and a box, assigns boxes to tracks at
// minimum cost, then updates the tracks.

#include "tracker.h"

#include <algorithm>
#include <cmath>

#include "assignment.h"
#include "box_grid.h"
#include "ego_motion.h"
#include "occlusion.h"
#include "pipeline/reserve_ahead.h"
#include "track.h"

namespace pcl_bv::detail {
namespace {

constexpr double kGateCost = 16;                   // four standard deviations, squared
constexpr std::size_t kOccludedFramesPerMiss = 4;  // occluded frames that are counted as one missed frame
constexpr std::size_t kSplitDetections = 5;        // detections of a track that prove a split

bool contains_point(const Aabb& box, const Eigen::Vector3d& position) {
  return (box.min().array() <= position.array()).all() && (position.array() <= box.max().array()).all();
}

Pose after_motion(const Pose& sensor, const PlanarMotion& motion) {
  Pose step = Pose::Identity();
  step.linear() = Eigen::AngleAxisd(motion.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  step.translation() << motion.shift, 0;
  Pose next = sensor * step.inverse();
  // Rotations are normalised, so that rounding errors do not add up over days.
  next.linear() = Eigen::Quaterniond(next.linear()).normalized().toRotationMatrix();
  return next;
}

// If the parts of an object have become one cluster, the oldest of their tracks gets it. Without this cost,
// the nearest track gets it, and ids change 25.9 instead of 23.7 times in 1000 matches (rural road).
double cost_of_youth(const Track& track) {
  return 4 / (1 + static_cast<double>(track.detections) / 15);
}

}  // namespace

struct Tracker::State {
  void move_sensor(double seconds, const std::vector<Aabb>& boxes, const std::optional<Pose>& pose);
  void find_sensor(double seconds, const std::vector<Aabb>& boxes);
  void find_pairs(const std::vector<Aabb>& boxes, double gate);
  void assign_boxes(const std::vector<Aabb>& boxes, const Viewpoints& viewpoints,
                    std::vector<Assignment>& assignments);
  void count_misses(const std::vector<Aabb>& boxes, const Viewpoints& viewpoints,
                    std::vector<Assignment>& assignments);
  void start(const std::vector<Aabb>& boxes, std::size_t box, std::vector<Assignment>& assignments);
  std::size_t box_of_whole(const Track& track) const;
  void find_splits(std::vector<Assignment>& assignments);
  void prune(std::size_t death);
  std::size_t free_slot();
  Eigen::Vector3d apparent_velocity(const Eigen::Vector3d& position) const;

  std::vector<Track> tracks;
  std::vector<std::size_t> free;
  std::vector<char> track_taken, box_taken;
  std::vector<Aabb> expected;  // for `ego`: static_box() of the tracks detected in the last frame
  // For each measured box: expected_box() of its assigned track before correct(); an empty box if it has no
  // track.
  std::vector<Aabb> predicted;
  std::vector<Aabb> wholes;  // whole_box() of the same tracks at the same time
  std::vector<AssignmentPair> pairs;
  BoxGrid grid;
  SparseAssignment assignment;
  EgoMotion ego;
  PlanarMotion step;  // motion of static points in the sensor's frame within step_seconds
  double step_seconds = 0;
  Pose sensor = Pose::Identity();
  bool has_given_poses = false;  // whether tracks are in the frame of given poses
  std::int64_t last_stamp_ns = 0;
  bool started = false, poses_given = false;
  double elapsed = 0;  // seconds since the last frame; 0 if unknown
  std::uint32_t next_id = 0;
};

// Returns the velocity, relative to the sensor, of a static point at `position`.
Eigen::Vector3d Tracker::State::apparent_velocity(const Eigen::Vector3d& position) const {
  if (!(step_seconds > 0)) return Eigen::Vector3d::Zero();
  const Eigen::Vector2d now = position.head<2>(), before = step.inverse() * now;
  const Eigen::Vector2d velocity = (now - before) / step_seconds;
  return {velocity.x(), velocity.y(), 0};
}

void Tracker::State::find_sensor(double seconds, const std::vector<Aabb>& boxes) {
  expected.clear();
  for (const Track& track : tracks)
    if (track.active && track.missed + track.occluded == 0) expected.push_back(track.static_box(sensor));
  PlanarMotion guess;
  if (step_seconds > 0) {
    const double part = seconds / step_seconds;
    guess = {part * step.yaw, part * step.shift};
  }
  PlanarMotion motion = guess;
  const bool found = ego.estimate(expected, boxes, guess, motion);
  sensor = after_motion(sensor, motion);
  // A step of less than 20 ms is not stored as the last motion, because the sensor moves less than the noise
  // of positions in this time.
  if (!found || seconds < 0.02) return;
  step = motion;
  step_seconds = seconds;
}

void Tracker::State::move_sensor(double seconds, const std::vector<Aabb>& boxes,
                                 const std::optional<Pose>& pose) {
  if (!pose || !has_given_poses) find_sensor(seconds, boxes);
  if (pose && !has_given_poses) {  // moves existing tracks into the fixed frame
    for (Track& track : tracks) {
      const Eigen::Matrix3d rotation = pose->linear() * sensor.linear().transpose();
      const Eigen::Vector3d position =
          rotation * (track.motion.position() - sensor.translation()) + pose->translation();
      const Eigen::Vector3d velocity = rotation * track.motion.velocity();
      for (int i = 0; i < 3; ++i) {
        track.motion.axes[static_cast<std::size_t>(i)].position = position[i];
        track.motion.axes[static_cast<std::size_t>(i)].velocity = velocity[i];
      }
      track.known.box.setEmpty();  // its axes are those of the old frame
    }
    has_given_poses = true;
  }
  if (pose) sensor = *pose;
  for (Track& track : tracks)
    if (track.active) track.expect(sensor);
}

void Tracker::State::find_pairs(const std::vector<Aabb>& boxes, double gate) {
  pairs.clear();
  grid.fill(boxes, 3 * gate);
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    const Track& track = tracks[t];
    if (!track.active) continue;
    grid.visit_near(track.expected_box().center(), [&](std::size_t b) {
      const double cost = cost_of(track, boxes[b], gate) + (track.id ? 0 : 1) + cost_of_youth(track);
      if (cost < kGateCost) pairs.push_back({t, b, cost});
    });
  }
}

void Tracker::State::assign_boxes(const std::vector<Aabb>& boxes, const Viewpoints& viewpoints,
                                  std::vector<Assignment>& assignments) {
  track_taken.assign(tracks.size(), 0);
  box_taken.assign(boxes.size(), 0);
  predicted.assign(boxes.size(), Aabb());
  wholes.assign(boxes.size(), Aabb());
  assignment.solve(tracks.size(), boxes.size(), pairs, kGateCost);
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    const std::size_t b = assignment.columns()[t];
    if (b == SparseAssignment::none) continue;
    track_taken[t] = box_taken[b] = 1;
    predicted[b] = tracks[t].expected_box();
    wholes[b] = tracks[t].whole_box();
    tracks[t].correct(boxes[b], sensor, elapsed, viewpoints);
    assignments[b].slot = t;
  }
}

// Counts missed frames. A track is occluded if its expected centre is inside the box of another track: its
// object is probably part of that box. A track with an id is also occluded if boxes hide its centre from
// every sensor. An occluded track is deleted later than others, so that it continues when its object is seen
// again. But if a split is not yet confirmed and the parts are one box again, the younger track was a part of
// the older one and is deleted. Otherwise both would continue and take turns, with the same object. A track
// that disappears in a box that was as large before was a part of that object, too: the box is not merged.
void Tracker::State::count_misses(const std::vector<Aabb>& boxes, const Viewpoints& viewpoints,
                                  std::vector<Assignment>& assignments) {
  for (std::size_t t = 0; t < track_taken.size(); ++t) {
    Track& track = tracks[t];
    if (!track.active || track_taken[t] != 0) continue;
    bool merged = false;
    const Eigen::Vector3d centre = track.expected_box().center();
    const std::size_t box_of_older = box_of_whole(track);
    grid.visit_near(centre, [&](std::size_t b) {
      if (!contains_point(boxes[b], centre)) return;
      merged = true;
      if (b == box_of_older) track.active = false;
      const std::size_t slot = assignments[b].slot;
      if (box_taken[b] != 0 && !track.inside_of) {
        track.inside_of = slot;
        track.is_part = is_inside(track.expected_box(), wholes[b]);
      }
      const bool is_part = track.inside_of == slot && track.is_part;
      if (track.id && track.active && !is_part) assignments[b].merged = true;
    });
    if (merged) track.detections_since_split = 0;
    const bool occluded = merged || (track.id && viewpoints.occluded(centre, boxes));
    if (occluded && ++track.occluded % kOccludedFramesPerMiss != 0) continue;
    ++track.missed;
  }
}

void Tracker::State::start(const std::vector<Aabb>& boxes, std::size_t box,
                           std::vector<Assignment>& assignments) {
  const std::size_t slot = free_slot();
  tracks[slot].start(boxes[box], sensor);
  assignments[box].slot = slot;
  assignments[box].fresh = true;
  const Eigen::Vector3d centre = boxes[box].center();
  grid.visit_near(centre, [&](std::size_t b) {
    if (box_taken[b] != 0 && contains_point(predicted[b], centre))
      tracks[slot].split_from = assignments[b].slot;
  });
}

// Returns the box of the track from which this track has split, or none. A split is over when it is
// confirmed, or when the other track is deleted: a reused slot holds a younger track.
std::size_t Tracker::State::box_of_whole(const Track& track) const {
  if (!track.split_from) return SparseAssignment::none;
  const Track& other = tracks[*track.split_from];
  return other.active && other.age > track.age ? assignment.columns()[*track.split_from]
                                               : SparseAssignment::none;
}

void Tracker::State::find_splits(std::vector<Assignment>& assignments) {
  for (const Assignment& own : assignments) {
    Track& track = tracks[own.slot];
    if (!track.split_from || ++track.detections_since_split < kSplitDetections) continue;
    const Track& other = tracks[*track.split_from];
    const bool is_active = other.active && other.age > track.age;  // a reused slot holds a younger track
    const std::size_t box = is_active ? assignment.columns()[*track.split_from] : SparseAssignment::none;
    if (box != SparseAssignment::none) assignments[box].separated = true;
    if (!is_active || box != SparseAssignment::none) track.split_from.reset();
  }
}

void Tracker::State::prune(std::size_t death) {
  free.clear();
  for (std::size_t t = tracks.size(); t-- > 0;) {
    Track& track = tracks[t];
    track.active = track.active && track.missed < death;
    ++track.age;
    if (!track.active) free.push_back(t);
  }
}

std::size_t Tracker::State::free_slot() {
  if (free.empty()) {
    tracks.emplace_back();
    return tracks.size() - 1;
  }
  const std::size_t slot = free.back();
  free.pop_back();
  return slot;
}

Tracker::Tracker() : state_(std::make_unique<State>()) {}
Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

void Tracker::update(std::int64_t stamp_ns, const std::vector<Aabb>& boxes, const TrackConfig& config,
                     std::vector<Assignment>& assignments, const std::optional<Pose>& pose,
                     const Viewpoints& viewpoints) {
  predict(stamp_ns, boxes, pose);
  assign(boxes, config, assignments, viewpoints);
}

void Tracker::predict(std::int64_t stamp_ns, const std::vector<Aabb>& boxes,
                      const std::optional<Pose>& pose) {
  State& s = *state_;
  const double passed = 1e-9 * (static_cast<double>(stamp_ns) - static_cast<double>(s.last_stamp_ns));
  s.elapsed = s.started && passed > 0 && passed <= 1 ? passed : 0;
  s.started = true;
  s.last_stamp_ns = stamp_ns;
  // Reserves more capacity than this frame needs. If a sequence is replayed, the tracks of its end are still
  // active when the tracks of its beginning start again. Even then update() must not allocate.
  if (s.tracks.capacity() < 2 * boxes.size()) s.tracks.reserve(4 * boxes.size());
  s.track_taken.reserve(s.tracks.capacity());
  s.free.reserve(s.tracks.capacity());
  s.expected.reserve(s.tracks.capacity());
  s.pairs.reserve(4 * s.tracks.capacity());
  for (Track& track : s.tracks)
    if (track.active) track.predict(s.elapsed);
  s.move_sensor(s.elapsed, boxes, pose);
  s.poses_given = pose.has_value();
}

void Tracker::assign(const std::vector<Aabb>& boxes, const TrackConfig& config,
                     std::vector<Assignment>& assignments, const Viewpoints& viewpoints) {
  State& s = *state_;
  reserve_ahead(assignments, boxes.size());
  reserve_ahead(s.box_taken, boxes.size());
  reserve_ahead(s.predicted, boxes.size());
  reserve_ahead(s.wholes, boxes.size());
  assignments.assign(boxes.size(), Assignment());
  s.find_pairs(boxes, config.gate);
  s.assign_boxes(boxes, viewpoints, assignments);
  s.count_misses(boxes, viewpoints, assignments);
  s.prune(config.death);
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    if (s.box_taken[b] == 0) s.start(boxes, b, assignments);
    Track& track = s.tracks[assignments[b].slot];
    assignments[b].moving = track.moving;
    assignments[b].velocity = s.sensor.linear().transpose() * track.motion.velocity();
    if (!track.id && track.detections >= config.birth) track.id = s.next_id++;
    if (track.id)
      assignments[b].track =
          track.entry(s.sensor, s.poses_given, s.apparent_velocity(track.expected_position));
  }
  s.find_splits(assignments);
}

void Tracker::list_known(std::vector<KnownObject>& known) const {
  known.clear();
  known.reserve(state_->tracks.capacity());
  for (std::size_t t = 0; t < state_->tracks.size(); ++t) {
    const Track& track = state_->tracks[t];
    if (!track.active || track.known.box.isEmpty()) continue;
    known.push_back(track.known);
    known.back().slot = t;
    known.back().detections = track.detections;
    known.back().missed = track.missed;
    known.back().has_id = track.id.has_value();
  }
  std::sort(known.begin(), known.end(), [](const KnownObject& a, const KnownObject& b) {
    const double x = a.box.center().x(), other = b.box.center().x();
    return x != other ? x < other : a.slot < b.slot;
  });
}

void Tracker::know(std::size_t slot, const Eigen::AlignedBox3d& box, Refinement refinement) {
  state_->tracks[slot].known.add(box, refinement);
}

void Tracker::list_active(std::vector<std::uint32_t>& ids) const {
  ids.clear();
  ids.reserve(state_->tracks.capacity());
  for (const Track& track : state_->tracks)
    if (track.active && track.id) ids.push_back(*track.id);
  std::sort(ids.begin(), ids.end());
}

const Pose& Tracker::sensor() const {
  return state_->sensor;
}

void Tracker::reset() {
  for (Track& track : state_->tracks)
    track.active = false;
  state_->started = false;
  state_->has_given_poses = false;
  state_->step = PlanarMotion();
  state_->step_seconds = 0;
  state_->sensor = Pose::Identity();
}

}  // namespace pcl_bv::detail
