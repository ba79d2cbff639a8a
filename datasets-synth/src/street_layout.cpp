// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The street as a table of rows. Each row repeats one kind of object along the infinite road.
#include "street_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pcl_bv::detail {
namespace {

constexpr double road_center = 0.5 * (street_curb_left + street_curb_right);
constexpr double ego_speed = 8;  // m/s along the road

/// A row of slots along the road. All slots move at `speed` over the ground. Each slot has an object with
/// probability `share`.
struct Row {
  Model (*make)(SplitMix64& random);
  double spacing;  // distance between two slots, metres
  double shift;    // offset of the slots' middles, metres forward
  double jitter;   // largest random offset of an object in its slot, metres forward or backward
  double side;     // metres left of the middle of the road
  double share;    // probability that a slot has an object
  double speed;    // m/s forward
  bool tilted;     // whether the object's up axis is normal to the slope instead of vertical
};

// All objects are more than 0.5 m apart for all random sizes, so that clustering with a tolerance of 0.5 m
// never joins two objects. Objects of rows with different `side` are at least 0.7 m apart in y. Half widths
// in metres: posts 0.3, people 0.34, trees 1.5, cars 1.02 (rotated), hedges 0.42 (rotated), houses 4.6 (with
// bays). The cars in the sensor's lane have their centres at least 8 m ahead of or behind the sensor.
// clang-format off
constexpr std::array rows{
    //                     spacing shift jitter  side  share  speed    tilted
    Row{make_car,              7.5,   0,  0.5,   4.45, 0.42,  0,         true},
    Row{make_car,              7.5,   0,  0.5,  -4.45, 0.42,  0,         true},
    Row{make_car,               24,   0,    4,   -1.6, 0.7,   ego_speed, true},
    Row{make_car,               20,   0,    6,    1.6, 0.5, -11,         true},
    Row{make_lamp_post,         30,   0,    0,    6.5, 1,     0,        false},
    Row{make_lamp_post,         30,   0,    0,   -6.5, 1,     0,        false},
    Row{make_sign_post,         15,   0,    4,    6.5, 0.4,   0,        false},
    Row{make_sign_post,         15,   0,    4,   -6.5, 0.4,   0,        false},
    Row{make_pedestrian,        12,   0,    5,    7.9, 0.3,   1.3,      false},
    Row{make_pedestrian,        12,   0,    5,    9.4, 0.3,  -1.2,      false},
    Row{make_pedestrian,        12,   0,    5,   -7.9, 0.3,   1.5,      false},
    Row{make_pedestrian,        12,   0,    5,   -9.4, 0.3,  -1.1,      false},
    Row{make_hedge_or_wall,    7.5,   0,    0,   10.9, 0.75,  0,         true},
    Row{make_hedge_or_wall,    7.5,   0,    0,  -10.9, 0.75,  0,         true},
    Row{make_tree,              15,  -3,  1.2,   13.6, 0.6,   0,        false},
    Row{make_tree,              15,  -3,  1.2,  -13.6, 0.6,   0,        false},
    Row{make_bush,              15,   3,  1.5,   13.6, 0.5,   0,        false},
    Row{make_bush,              15,   3,  1.5,  -13.6, 0.5,   0,        false},
    Row{make_house,             15,   0,  0.4,   20.5, 0.8,   0,        false},
    Row{make_house,             15,   0,  0.4,  -20.5, 0.8,   0,        false},
    Row{make_tree,               9,   0,    2,     32, 0.8,   0,        false},
    Row{make_tree,               9,   0,    2,    -32, 0.8,   0,        false},
};
// clang-format on

/// Maps 0, -1, 1, -2, 2, ... to 0, 1, 2, 3, 4, ...
std::uint64_t zigzag(std::int64_t i) {
  return i >= 0 ? 2 * static_cast<std::uint64_t>(i) : 2 * static_cast<std::uint64_t>(-(i + 1)) + 1;
}

/// Sets the axes for a heading of `yaw` radians left of +x.
void orient(PlacedObject& object, double yaw, bool tilted) {
  const double slope = tilted ? street_slope : 0;
  object.up = normalized({-slope, 0, 1});
  object.forward = normalized({std::cos(yaw), std::sin(yaw), slope * std::cos(yaw)});
  object.left = cross(object.up, object.forward);
}

/// Returns the height of the base of an object at (x, y). The base of an upright object is at the lowest
/// ground height below the object.
double base_height(const PlacedObject& object, const Row& row, double x, double y) {
  const double ground = street_ground_height(x, y);
  if (row.tilted) return ground;
  const Box3& bounds = object.model.bounds;
  return ground - street_slope * std::max(std::abs(bounds.lo.x), std::abs(bounds.hi.x));
}

PlacedObject place(std::uint64_t seed, double seconds, std::size_t row_number, std::int64_t slot) {
  const Row& row = rows[row_number];
  const auto id = static_cast<std::uint32_t>(1 + rows.size() * zigzag(slot) + row_number);
  SplitMix64 random({seed, id});
  if (random.uniform() >= row.share) return {};
  const double along = (static_cast<double>(slot) + 0.5) * row.spacing + row.shift +
                       random.uniform(-row.jitter, row.jitter) + (row.speed - ego_speed) * seconds;
  const double across = road_center + row.side;
  // A moving object faces its direction of motion. Static objects on the right side of the road face forward,
  // and those on the left side face backward. Parked cars then point in their lane's direction. The fronts of
  // houses, which are on the left of their forward axis, face the road.
  const bool backward = row.speed != 0 ? row.speed < 0 : row.side > 0;
  const double yaw = backward ? std::numbers::pi : 0;
  PlacedObject object;
  object.id = id;
  object.model = row.make(random);
  orient(object, yaw + (row.speed == 0 && row.tilted ? random.uniform(-0.02, 0.02) : 0), row.tilted);
  object.base = {along, across, base_height(object, row, along, across)};
  object.velocity = (row.speed - ego_speed) * Vec3{1, 0, street_slope};
  return object;
}

}  // namespace

std::vector<PlacedObject> place_objects(std::uint64_t seed, std::size_t frame) {
  const double seconds = static_cast<double>(frame) * street_frame_seconds;
  std::vector<PlacedObject> objects;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const double origin = rows[row].shift + (rows[row].speed - ego_speed) * seconds;
    const double max_distance = street_max_range + rows[row].spacing;
    const auto first = static_cast<std::int64_t>(std::floor((-max_distance - origin) / rows[row].spacing));
    const auto last = static_cast<std::int64_t>(std::ceil((max_distance - origin) / rows[row].spacing));
    for (std::int64_t slot = first; slot <= last; ++slot) {
      PlacedObject object = place(seed, seconds, row, slot);
      if (object.id != 0 && min_range(object) < street_max_range) objects.push_back(std::move(object));
    }
  }
  std::sort(objects.begin(), objects.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return objects;
}

double min_range(const PlacedObject& object) {
  const Vec3 sensor = object.to_local(Vec3{} - object.base);
  const Box3& bounds = object.model.bounds;
  const double x = std::max({bounds.lo.x - sensor.x, 0.0, sensor.x - bounds.hi.x});
  const double y = std::max({bounds.lo.y - sensor.y, 0.0, sensor.y - bounds.hi.y});
  return std::sqrt(x * x + y * y);
}

}  // namespace pcl_bv::detail
