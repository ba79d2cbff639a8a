// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "track_cut.h"

#include <algorithm>
#include <limits>

#include "geometry.h"

namespace pcl_bv::detail {
namespace {

constexpr std::uint32_t kRest = static_cast<std::uint32_t>(-1);

// A person who has been a part of a cluster for longer is not cut off any more: 6 s at 10 Hz.
constexpr std::size_t kMaxCut = 60;
constexpr std::size_t kMaxFramesMissed = 10;  // frames
constexpr double kExpectedMargin = 0.3;       // m; an expected person is this far outside the cluster at most
constexpr double kNearRadius = 2;             // m; radius around a person in which points are examined
constexpr double kMaxWholeWidth = 0.9;        // m; a cluster up to this width is one person
constexpr double kMinCutWidth = 1.3;          // m; up to this width, something else must be expected, too
constexpr double kBasinReach = 0.5;           // m; distance of a basin from the expected centre at most
constexpr double kMaxBasin = 1.2, kMaxPerson = 1.3;  // m; largest widths
constexpr std::size_t kMinPersonPoints = 10;         // fewer points have no density
constexpr double kMinHeightShare = 0.6;              // share of the known height

bool is_over(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& position, double margin) {
  return (position.head<2>().array() >= box.min().head<2>().array() - margin).all() &&
         (position.head<2>().array() <= box.max().head<2>().array() + margin).all();
}

}  // namespace

// Also lists the people expected in the cluster.
bool TrackCut::expects(const Eigen::AlignedBox3d& box, const std::vector<KnownObject>& known) {
  people_.clear();
  const double width = plan_width(box);
  if (width <= kMaxWholeWidth) return false;
  std::size_t expected = 0;
  const auto [first, last] =
      objects_between(known, box.min().x() - kExpectedMargin, box.max().x() + kExpectedMargin);
  for (const KnownObject* at = first; at != last; ++at) {
    const KnownObject& object = *at;
    if (!is_over(box, object.box.center(), kExpectedMargin)) continue;
    ++expected;
    if (object.upright() && object.whole > 0 && object.cut <= kMaxCut && object.missed <= kMaxFramesMissed)
      people_.emplace_back().expected = &object;
  }
  return !people_.empty() && (expected > 1 || width > kMinCutWidth);
}

void TrackCut::find_near(const std::vector<Eigen::Vector3d>& points) {
  near_.clear();
  plan_.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto near_person = [&](const Person& person) {
      return (points[i] - person.expected->box.center()).head<2>().squaredNorm() < kNearRadius * kNearRadius;
    };
    if (std::none_of(people_.begin(), people_.end(), near_person)) continue;
    near_.push_back(i);
    plan_.emplace_back(points[i].head<2>());
  }
}

void TrackCut::fill_basins(const std::vector<Eigen::Vector3d>& points, std::size_t count) {
  basins_.assign(count, Basin());
  for (std::size_t i = 0; i < near_.size(); ++i) {
    Basin& basin = basins_[basin_of_[i]];
    const Eigen::Vector3d& point = points[near_[i]];
    basin.sum += point.head<2>();
    ++basin.points;
    basin.box.extend(point);
  }
}

// Gives each narrow basin to the nearest expected person within reach.
void TrackCut::give_basins() {
  for (Basin& basin : basins_) {
    if (plan_width(basin.box) > kMaxBasin) continue;
    const Eigen::Vector2d mean = basin.sum / static_cast<double>(basin.points);
    double least = kBasinReach;
    for (Person& person : people_) {
      const double distance = (mean - person.expected->box.center().head<2>()).norm();
      if (distance >= least) continue;
      least = distance;
      basin.person = &person;
    }
    if (basin.person == nullptr) continue;
    basin.person->points += basin.points;
    basin.person->box.extend(basin.box);
  }
}

std::uint32_t TrackCut::number_people(std::size_t min_size) {
  std::uint32_t parts = 0;
  for (Person& person : people_) {
    person.found = person.points >= min_size && plan_width(person.box) <= kMaxPerson &&
                   person.box.sizes().z() >= kMinHeightShare * person.expected->box.sizes().z();
    if (person.found) person.part = parts++;
  }
  return parts;
}

// Gives a rest that is too small for an object to the nearest people.
void TrackCut::give_rest(const std::vector<Eigen::Vector3d>& points,
                         std::vector<std::uint32_t>& part_of) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (part_of[i] != kRest) continue;
    double least = std::numeric_limits<double>::infinity();
    for (const Person& person : people_) {
      const double distance = (points[i] - person.expected->box.center()).head<2>().norm();
      if (!person.found || distance >= least) continue;
      least = distance;
      part_of[i] = person.part;
    }
  }
}

void TrackCut::reserve(std::size_t points, const Eigen::AlignedBox3d& box, double cell) {
  plan_basins_.reserve(points, box.sizes().head<2>(), cell);
  near_.reserve(points);
  plan_.reserve(points);
  basin_of_.reserve(points);
  basins_.reserve(points);
  people_.reserve(64);
}

std::size_t TrackCut::find(const std::vector<Eigen::Vector3d>& points, const Eigen::AlignedBox3d& box,
                           const std::vector<KnownObject>& known, double cell, std::size_t min_size,
                           std::vector<std::uint32_t>& part_of) {
  min_size = std::max(min_size, kMinPersonPoints);
  if (!expects(box, known)) return 1;
  find_near(points);
  if (near_.size() < min_size) return 1;
  fill_basins(points, plan_basins_.find(plan_, cell, basin_of_));
  give_basins();
  const std::uint32_t parts = number_people(min_size);
  if (parts == 0) return 1;
  part_of.assign(points.size(), kRest);
  std::size_t rest = points.size();
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const Person* const person = basins_[basin_of_[i]].person;
    if (person == nullptr || !person->found) continue;
    part_of[near_[i]] = person->part;
    --rest;
  }
  if (rest < min_size) {
    give_rest(points, part_of);
    return parts;
  }
  std::replace(part_of.begin(), part_of.end(), kRest, parts);
  return parts + 1;
}

}  // namespace pcl_bv::detail
