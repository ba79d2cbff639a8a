// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/synth/rural_road.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "rural_road_layout.h"
#include "rural_road_world.h"
#include "street_cast.h"
#include "sweep.h"

namespace pcl_bv {
using namespace detail;
namespace rural_road {
namespace {

constexpr double kDropped = 0.015, kReflected = 1.0 / 700, kGrassProbability = 0.75;
constexpr double kRadians = std::numbers::pi / 180;

struct Sensor {
  std::size_t beams, columns;
  double height, pitch, roll;  // height in metres; pitch (nose down) and roll (left side down) in degrees
};

Sensor sensor_of(std::size_t beams) {
  switch (beams) {
    case 16:
      return {16, 1800, 1.2, 0, 0};
    case 32:
      return {32, 1800, 2.4, 5, 0};
    case 64:
      return {64, 2000, street_sensor_height, 0, 0};
    case 128:
      return {128, 1800, 2, 0, 2};
    default:
      throw std::invalid_argument("rural road: beams is " + std::to_string(beams) +
                                  ", must be 16, 32, 64 or 128");
  }
}

// Elevation of a beam, degrees.
double elevation_of(std::size_t beams, std::size_t row) {
  const auto i = static_cast<double>(row);
  if (beams == 16) return 15 - 2 * i;
  if (beams == 32) return 10.67 - i * 41.34 / 31;
  if (row < 32) return 15 - i * 13 / 32;
  return row < 96 ? 2 - (i - 32) / 8 : -6 - (i - 96) * 19 / 31;
}

Vec3 ray_of(const Sensor& sensor, std::size_t row, std::size_t column) {
  if (sensor.beams == street_beams) {
    const auto [x, y, z] = street_beam(static_cast<double>(row), column, sensor.columns);
    return {x, y, z};
  }
  const double elevation = elevation_of(sensor.beams, row) * kRadians;
  const double azimuth = azimuth_of(static_cast<double>(column), sensor.columns);
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

/// Pose of the sensor in the fixed frame.
struct Mount {
  Vec3 sensor_position, forward, left, up;

  Vec3 to_sensor(Vec3 v) const { return {dot(v, forward), dot(v, left), dot(v, up)}; }
  Vec3 to_fixed(Vec3 v) const { return v.x * forward + v.y * left + v.z * up; }
};

Mount mount(const World& world, const Sensor& sensor, double along) {
  const PlacedObject car = on_road(world, {along, own_lane}, false, true);
  const double p = sensor.pitch * kRadians, r = sensor.roll * kRadians;
  const Vec3 forward = std::cos(p) * car.forward - std::sin(p) * car.up;
  const Vec3 up = std::sin(p) * car.forward + std::cos(p) * car.up;
  return {car.base + sensor.height * car.up, forward, std::cos(r) * car.left - std::sin(r) * up,
          std::sin(r) * car.left + std::cos(r) * up};
}

std::array<double, 3> to_array(Vec3 v) {
  return {v.x, v.y, v.z};
}

PlacedObject in_sensor_frame(const Mount& sensor, PlacedObject object) {
  object.base = sensor.to_sensor(object.base - sensor.sensor_position);
  object.forward = sensor.to_sensor(object.forward);
  object.left = sensor.to_sensor(object.left);
  object.up = sensor.to_sensor(object.up);
  return object;
}

RuralRoadObject truth_of(const PlacedObject& seen, const PlacedRoadObject& placed) {
  const Box3& bounds = seen.model.bounds;
  return {seen.id,
          seen.model.kind,
          to_array(seen.to_sensor(0.5 * (bounds.lo + bounds.hi))),
          {to_array(seen.forward), to_array(seen.left), to_array(seen.up)},
          to_array(0.5 * (bounds.hi - bounds.lo)),
          to_array(placed.object.velocity),
          placed.yaw_rate};
}

enum class ReturnKind : std::uint8_t { nothing, object, ground, grass, reflection };

struct Return {
  double range = 0;
  ReturnKind kind = ReturnKind::nothing;
};

// Adds noise, missing returns and false returns to a hit. Grass of height `grass` may stop a ray before the
// ground. The false return of a reflected ray is below the ground. `descent_rate` is the ray's descent in
// metres per metre of range. above(range) returns the ray's height above the ground at `range`.
template <typename Above>
Return return_of(const Ray& ray, const Hit& hit, bool ground, double grass, double descent_rate,
                 Above above) {
  SplitMix64 random(ray.key);
  const double noise = street_range_noise * random.normal();
  const bool dropped = random.uniform() < std::max(kDropped, hit.loss_probability);
  const double luck = random.uniform();
  if (hit.range >= street_max_range || dropped) return {};
  if (!ground) return {hit.range + noise, ReturnKind::object};
  if (luck < kReflected) return {hit.range * random.uniform(1.15, 1.6) + noise, ReturnKind::reflection};
  if (grass > 0 && random.uniform() < kGrassProbability) {
    const double blade = grass * random.uniform(0.2, 1);
    double back = std::min(blade / std::max(descent_rate, 0.02), 1.5);
    // `back` assumes level ground. Where the ground falls towards the sensor, as in a ditch, the ray may be
    // above the grass at the range hit.range - back. `back` is then halved until the ray is in the grass.
    while (back > 0.01 && above(hit.range - back) > grass)
      back *= 0.5;
    return {hit.range - back + noise, ReturnKind::grass};
  }
  return {hit.range + noise, ReturnKind::ground};
}

struct Sweep {
  const Sensor& sensor;
  const Mount& at;
  const Terrain& terrain;
  const std::vector<PlacedObject>& objects;
  std::uint64_t seed, frame;

  void record(const Ray& ray, SynthCloud& cloud, std::size_t i,
              const std::vector<ColumnCandidate>& candidates) const {
    Hit hit;
    for (const ColumnCandidate& candidate : candidates) {
      if (candidate.min_range >= hit.range) break;
      cast(ray, *candidate.object, hit);
    }
    const Vec3 direction = at.to_fixed(ray.direction);
    const double range = terrain.cast(at.sensor_position, direction);
    const bool ground = range < hit.range;
    double grass = 0;
    if (ground) {
      hit = {range, 0, 0};
      const Vec3 p = at.sensor_position + range * direction;
      grass = terrain.grass(p.x, p.y);
    }
    const auto above = [&](double r) {
      const Vec3 p = at.sensor_position + r * direction;
      return p.z - terrain.height(p.x, p.y);
    };
    const Return seen = return_of(ray, hit, ground, grass, -direction.z, above);
    if (seen.kind == ReturnKind::nothing) return;
    const Vec3 point = seen.range * ray.direction;
    cloud.xyz[3 * i] = static_cast<float>(point.x);
    cloud.xyz[3 * i + 1] = static_cast<float>(point.y);
    cloud.xyz[3 * i + 2] = static_cast<float>(point.z);
    cloud.object[i] = hit.object;
    cloud.ground[i] = seen.kind == ReturnKind::ground;
    cloud.vegetation[i] = seen.kind == ReturnKind::grass;
    if (hit.object == 0) return;
    const auto object = std::lower_bound(objects.begin(), objects.end(), hit.object,
                                         [](const PlacedObject& o, std::uint32_t id) { return o.id < id; });
    cloud.kind[i] = 1 + static_cast<std::uint32_t>(object->model.kind);
  }

  SynthCloud make() const {
    const auto candidates = candidates_by_column(objects, sensor.columns);
    const std::size_t rays = sensor.beams * sensor.columns;
    SynthCloud cloud;
    cloud.xyz.resize(3 * rays);
    for (auto* labels : {&cloud.object, &cloud.ground, &cloud.vegetation, &cloud.kind})
      labels->resize(rays);
    cloud.height = sensor.beams;
    for (std::size_t i = 0; i < rays; ++i) {
      const std::size_t column = i % sensor.columns;
      const Ray ray{ray_of(sensor, i / sensor.columns, column), SplitMix64({seed, frame, i}).next()};
      record(ray, cloud, i, candidates[column]);
    }
    return cloud;
  }
};

}  // namespace
}  // namespace rural_road

namespace rural_road {
namespace {

/// The ground truth of a frame, and the sensor, world and objects for casting its rays.
struct Scene {
  Scene(const RuralRoadOptions& options, std::size_t frame)
      : sensor(sensor_of(options.beams)),
        seconds(static_cast<double>(frame) * street_frame_seconds),
        along(driven_distance(options.seed, seconds)),
        world(options.seed, along),
        at(mount(world, sensor, along)) {
    for (const PlacedRoadObject& placed : place_road_objects(world, options.seed, seconds)) {
      PlacedObject seen = in_sensor_frame(at, placed.object);
      if (min_range(seen) >= street_max_range) continue;
      result.objects.push_back(truth_of(seen, placed));
      objects.push_back(std::move(seen));
    }
    result.pose = {at.forward.x, at.left.x, at.up.x, at.sensor_position.x,
                   at.forward.y, at.left.y, at.up.y, at.sensor_position.y,
                   at.forward.z, at.left.z, at.up.z, at.sensor_position.z};
  }

  Sensor sensor;
  double seconds, along;
  World world;
  Mount at;
  std::vector<PlacedObject> objects;
  RuralRoadFrame result;
};

}  // namespace
}  // namespace rural_road

RuralRoadFrame make_rural_road_frame(const RuralRoadOptions& options, std::size_t frame) {
  rural_road::Scene scene(options, frame);
  const rural_road::Terrain terrain(scene.world, options.seed, scene.at.sensor_position.x,
                                    scene.at.sensor_position.y);
  scene.result.cloud =
      rural_road::Sweep{scene.sensor, scene.at, terrain, scene.objects, options.seed, frame}.make();
  return std::move(scene.result);
}

RuralRoadFrame make_rural_road_truth(const RuralRoadOptions& options, std::size_t frame) {
  return rural_road::Scene(options, frame).result;
}

double rural_road_ground_height(std::uint64_t seed, std::size_t frame, double x, double y) {
  return rural_road::World(
             seed, rural_road::driven_distance(seed, static_cast<double>(frame) * street_frame_seconds))
      .height(x, y);
}

}  // namespace pcl_bv
