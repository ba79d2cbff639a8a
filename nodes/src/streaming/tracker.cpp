// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Greedy nearest-neighbour association with constant velocity.

#include "pcl_bv/nodes/tracker.h"

#include <algorithm>
#include <tuple>

#include "box_grid.h"

namespace pcl_bv {
namespace {

// How much of what a sighting contradicts is believed: centres of partial views jump by decimetres.
constexpr double kPositionGain = 0.8;
constexpr double kVelocityGain = 0.5;

}  // namespace

Tracker::Tracker() : grid_(std::make_unique<BoxGrid>()) {}
Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

void Tracker::find_pairs(double seconds, const std::vector<Aabb>& boxes, double gate) {
  pairs_.clear();
  grid_->fill(boxes, 2 * gate);
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const Track& track = tracks_[t];
    if (!track.alive) continue;
    const Eigen::Vector3d expected = track.center + seconds * track.velocity;
    grid_->visit_near(expected, [&](std::size_t b) {
      const Eigen::Vector3d size = boxes[b].max() - boxes[b].min();
      const double distance = (boxes[b].center() - expected).norm();
      const double difference = (size - track.size).norm() / 2;
      if (distance <= gate + std::min(difference, gate)) pairs_.push_back({distance + difference, t, b});
    });
  }
  std::sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.cost, a.track, a.box) < std::tie(b.cost, b.track, b.box);
  });
}

// The second sighting is the first that says anything about the velocity, and is believed.
void Tracker::correct(Track& track, const Aabb& box, double seconds) const {
  const bool second = track.seen == 1;
  const double passed = track.unseen + seconds;
  const Eigen::Vector3d expected = track.center + seconds * track.velocity;
  const Eigen::Vector3d surprise = box.center() - expected;
  if (passed > 0) track.velocity += (second ? 1.0 : kVelocityGain) / passed * surprise;
  track.center = expected + (second ? 1.0 : kPositionGain) * surprise;
  track.size = box.max() - box.min();
  track.unseen = 0;
  track.missed = 0;
  ++track.seen;
}

void Tracker::join(double seconds, const std::vector<Aabb>& boxes, std::vector<Assignment>& assignments) {
  track_taken_.assign(tracks_.size(), 0);
  box_taken_.assign(boxes.size(), 0);
  for (const Pair& pair : pairs_) {
    if (track_taken_[pair.track] != 0 || box_taken_[pair.box] != 0) continue;
    track_taken_[pair.track] = box_taken_[pair.box] = 1;
    correct(tracks_[pair.track], boxes[pair.box], seconds);
    assignments[pair.box].slot = pair.track;
  }
  for (std::size_t t = 0; t < track_taken_.size(); ++t) {
    Track& track = tracks_[t];
    if (!track.alive || track_taken_[t] != 0) continue;
    ++track.missed;
    track.unseen += seconds;
    track.center += seconds * track.velocity;
  }
}

std::size_t Tracker::free_slot() {
  if (free_.empty()) {
    tracks_.emplace_back();
    return tracks_.size() - 1;
  }
  const std::size_t slot = free_.back();
  free_.pop_back();
  return slot;
}

void Tracker::update(std::int64_t stamp_ns, const std::vector<Aabb>& boxes, const TrackConfig& config,
                     std::vector<Assignment>& assignments) {
  const double passed = 1e-9 * (static_cast<double>(stamp_ns) - static_cast<double>(last_stamp_ns_));
  const double seconds = started_ && passed > 0 && passed <= 1 ? passed : 0;
  started_ = true;
  last_stamp_ns_ = stamp_ns;
  assignments.assign(boxes.size(), Assignment());
  // Room for what lives on while others come: a sequence that is seen again finds more tracks than it made.
  if (tracks_.capacity() < 2 * boxes.size()) tracks_.reserve(4 * boxes.size());
  track_taken_.reserve(tracks_.capacity());
  free_.reserve(tracks_.capacity());
  find_pairs(seconds, boxes, config.gate);
  join(seconds, boxes, assignments);
  free_.clear();
  for (std::size_t t = tracks_.size(); t-- > 0;) {
    tracks_[t].alive = tracks_[t].alive && tracks_[t].missed < config.death;
    ++tracks_[t].age;
    if (!tracks_[t].alive) free_.push_back(t);
  }
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    if (box_taken_[b] == 0) {
      const std::size_t slot = free_slot();
      Track& fresh = tracks_[slot] = Track();
      fresh.center = boxes[b].center();
      fresh.size = boxes[b].max() - boxes[b].min();
      fresh.seen = fresh.age = 1;
      fresh.alive = true;
      assignments[b] = {slot, true};
    }
    Track& track = tracks_[assignments[b].slot];
    if (!track.id && track.seen >= config.birth) track.id = next_id_++;
    if (track.id) assignments[b].track = {*track.id, track.age, track.velocity};
  }
}

void Tracker::reset() {
  for (Track& track : tracks_)
    track.alive = false;
  started_ = false;
}

}  // namespace pcl_bv
