// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The rural road as a table of rows. Each row repeats one kind of object along the infinite road.
#include "rural_road_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pcl_bv::rural_road {
using namespace detail;
namespace {

enum class Motion : std::uint8_t { static_object, constant_speed, with_sensor_car };

/// A row of slots along the road. Each slot has a group of objects with probability `share`.
struct Row {
  Model (*make)(SplitMix64& random);
  double spacing;  // distance between two slots, metres
  double jitter;   // largest random offset of a group in its slot, metres forward or backward
  double left;     // metres left of the middle of the road
  double share;    // probability that a slot has a group
  Motion motion;
  double speed;           // m/s forward, if `motion` is `constant_speed`
  bool tilted;            // whether the object's up axis is normal to the ground instead of vertical
  bool allowed_on_ditch;  // whether a group may be where the roadside is a ditch
  int max_group_size;     // maximum number of objects in a group
};

using enum Motion;

// clang-format off
constexpr std::array rows{
    //                  spacing jitter left share  motion          speed tilted ditch group
    Row{make_car,                26,    3, -1.75,  0.6, with_sensor_car,    0,  true,  true, 1},
    Row{make_car,                22,    5,  1.75, 0.55, constant_speed,    -9,  true,  true, 1},
    Row{make_cyclist,            31,    8,  -3.3,  0.5, constant_speed,   4.5,  true,  true, 1},
    Row{make_cyclist,            37,    8,   3.3,  0.4, constant_speed,  -5.5,  true,  true, 1},
    Row{make_pedestrian,         17,    5,   4.6, 0.45, constant_speed,   1.3, false,  true, 4},
    Row{make_pedestrian,         19,    5,  -4.6, 0.45, constant_speed,  -1.2, false,  true, 3},
    Row{make_car,                 8,  0.6,   6.6, 0.45, static_object,      0,  true, false, 1},
    Row{make_car,                 8,  0.6,  -6.6, 0.45, static_object,      0,  true, false, 1},
    Row{make_sign_post,          20,    4,   5.4,  0.5, static_object,      0, false,  true, 1},
    Row{make_lamp_post,          30,    0,  -5.4,    1, static_object,      0, false,  true, 1},
    Row{make_low_wall,            8,  0.2,   9.4,  0.4, static_object,      0,  true,  true, 1},
    Row{make_hedge_or_wall,       8,  0.2,  -9.4, 0.45, static_object,      0,  true,  true, 1},
    Row{make_avenue_tree,        14,    1,     8, 0.35, static_object,      0, false, false, 1},
    Row{make_avenue_tree,        14,    1,    -8, 0.35, static_object,      0, false, false, 1},
    Row{make_bush,               11,    3,    13,  0.6, static_object,      0, false,  true, 1},
    Row{make_tree,               11,    3,   -13,  0.6, static_object,      0, false,  true, 1},
    Row{make_house,              24,    2,    22,  0.6, static_object,      0, false,  true, 1},
    Row{make_house,              24,    2,   -22,  0.5, static_object,      0, false,  true, 1},
    Row{make_tree,                9,    3,    33,  0.7, static_object,      0, false,  true, 1},
    Row{make_tree,                9,    3,   -33,  0.7, static_object,      0, false,  true, 1},
    Row{make_bridge,            150,   20,     0,  0.9, static_object,      0, false,  true, 1},
};
// clang-format on

constexpr std::size_t kMembers = 4;         // ids per slot
constexpr double kMaxObjectDistance = 130;  // metres along the road from the sensor's car

// Maps 0, -1, 1, -2, 2, ... to 0, 1, 2, 3, 4, ...
std::uint64_t zigzag(std::int64_t i) {
  return i >= 0 ? 2 * static_cast<std::uint64_t>(i) : 2 * static_cast<std::uint64_t>(-(i + 1)) + 1;
}

// Returns the distance that the row's slots have moved along the road, metres.
double travelled_distance(const Row& row, std::uint64_t seed, double seconds) {
  return row.motion == static_object    ? 0
         : row.motion == constant_speed ? row.speed * seconds
                                        : driven_distance(seed, seconds);
}

// Returns the lowest ground height below an upright object, which is the height of the object's base.
double lowest_ground_below(const World& world, const PlacedObject& object) {
  const Box3& bounds = object.model.bounds;
  const double half = std::min(6.0, std::max(bounds.hi.x, bounds.hi.y));
  double low = world.height(object.base.x, object.base.y);
  for (const double angle : {0.0, 1.57, 3.14, 4.71})
    low = std::min(
        low, world.height(object.base.x + half * std::cos(angle), object.base.y + half * std::sin(angle)));
  return low;
}

struct RoadPose {
  RoadPosition position;
  bool backward;
};

PlacedObject put_on_ground(const World& world, const Row& row, const RoadPose& pose, const Model& model) {
  PlacedObject object = on_road(world, pose.position, pose.backward, row.tilted);
  object.model = model;
  if (!row.tilted && model.kind != SynthObjectKind::bridge)
    object.base.z = lowest_ground_below(world, object);
  return object;
}

void place_member(const World& world, std::uint64_t seed, double seconds, std::size_t row_number,
                  std::int64_t slot, std::size_t member, std::vector<PlacedRoadObject>& placed) {
  const Row& row = rows[row_number];
  const auto group = static_cast<std::uint32_t>(zigzag(slot) * rows.size() + row_number);
  SplitMix64 random({seed, 11, group});
  if (random.uniform() >= row.share) return;
  const auto size = static_cast<std::size_t>(1 + random.uniform() * row.max_group_size);
  if (member >= std::min<std::size_t>(size, kMembers)) return;
  const double start =
      (static_cast<double>(slot) + 0.5) * row.spacing + random.uniform(-row.jitter, row.jitter);
  const double apart = random.uniform(0.6, 1);
  if (!row.allowed_on_ditch && world.roadside_at(start, row.left > 0) == Roadside::ditch) return;
  SplitMix64 own({seed, 12, group, member});
  const Model model = row.make(own);
  const bool backward = row.motion == static_object ? row.left > 0 : row.speed < 0;
  const std::size_t row_of_two = member / 2;
  const double behind = static_cast<double>(row_of_two) * apart, beside = member % 2 == 0 ? 0 : 0.7;
  const auto at = [&](double time) {
    const double along = start + travelled_distance(row, seed, time) - behind;
    return put_on_ground(world, row, {{along, row.left + (row.left < 0 ? -beside : beside)}, backward},
                         model);
  };
  PlacedRoadObject result;
  result.object = at(seconds);
  result.object.id = static_cast<std::uint32_t>(1 + group * kMembers + member);
  if (row.motion != static_object) {
    constexpr double dt = 0.01;
    const PlacedObject before = at(seconds - dt), after = at(seconds + dt);
    const Vec3 middle = 0.5 * (model.bounds.lo + model.bounds.hi);
    result.object.velocity = (1 / (2 * dt)) * (after.to_sensor(middle) - before.to_sensor(middle));
    const double turned =
        std::atan2(after.forward.y, after.forward.x) - std::atan2(before.forward.y, before.forward.x);
    result.yaw_rate = std::remainder(turned, 2 * std::numbers::pi) / (2 * dt);
  }
  placed.push_back(std::move(result));
}

}  // namespace

PlacedObject on_road(const World& world, const RoadPosition& position, bool backward, bool tilted) {
  const double heading = world.road.heading(position.along);
  const Vec3 middle = world.road.at(position.along);
  PlacedObject object;
  const double x = middle.x - position.left * std::sin(heading),
               y = middle.y + position.left * std::cos(heading);
  object.base = {x, y, world.height(x, y)};
  object.up = tilted ? world.normal(x, y) : Vec3{0, 0, 1};
  const double sign = backward ? -1 : 1;
  const Vec3 level{sign * std::cos(heading), sign * std::sin(heading), 0};
  object.left = normalized(cross(object.up, level));
  object.forward = cross(object.left, object.up);
  return object;
}

std::vector<PlacedRoadObject> place_road_objects(const World& world, std::uint64_t seed, double seconds) {
  const double sensor_distance = driven_distance(seed, seconds);
  std::vector<PlacedRoadObject> placed;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const double origin = travelled_distance(rows[row], seed, seconds);
    const auto first = static_cast<std::int64_t>(
        std::floor((sensor_distance - kMaxObjectDistance - origin) / rows[row].spacing));
    const auto last = static_cast<std::int64_t>(
        std::ceil((sensor_distance + kMaxObjectDistance - origin) / rows[row].spacing));
    for (std::int64_t slot = first; slot <= last; ++slot) {
      // In the row that moves with the sensor's car, skip the slots near 0, where the sensor's car is.
      if (rows[row].motion == with_sensor_car &&
          std::abs((static_cast<double>(slot) + 0.5) * rows[row].spacing) < 12)
        continue;
      for (std::size_t member = 0; member < kMembers; ++member)
        place_member(world, seed, seconds, row, slot, member, placed);
    }
  }
  std::sort(placed.begin(), placed.end(),
            [](const auto& a, const auto& b) { return a.object.id < b.object.id; });
  return placed;
}

}  // namespace pcl_bv::rural_road
