// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The sweep of the street: casts the rays and adds the sensor's noise, missing returns and false returns.
#include "pcl_bv/synth/street.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "street_cast.h"
#include "sweep.h"

namespace pcl_bv {
using namespace detail;
namespace {

constexpr double dropped_share = 0.015;
constexpr double reflected_share = 1.0 / 700;

std::array<double, 3> to_array(Vec3 v) {
  return {v.x, v.y, v.z};
}

StreetObject truth_of(const PlacedObject& object) {
  const Box3& bounds = object.model.bounds;
  return {object.id,
          object.model.kind,
          to_array(object.to_sensor(0.5 * (bounds.lo + bounds.hi))),
          {to_array(object.forward), to_array(object.left), to_array(object.up)},
          to_array(0.5 * (bounds.hi - bounds.lo)),
          to_array(object.velocity)};
}

/// Writes the point that the sensor reports for a hit to position i of the cloud.
void record(const Ray& ray, Hit hit, bool ground, SynthCloud& cloud, std::size_t i) {
  SplitMix64 random(ray.key);
  const double noise = street_range_noise * random.normal();
  const bool dropped = random.uniform() < std::max(dropped_share, hit.loss_probability);
  const bool reflected = ground && random.uniform() < reflected_share;
  if (hit.range >= street_max_range || dropped) return;
  // The sensor assumes that a reflected ray goes straight on, so the false return lies below the ground.
  const double range = reflected ? hit.range * random.uniform(1.15, 1.6) : hit.range;
  const Vec3 point = (range + noise) * ray.direction;
  cloud.xyz[3 * i] = static_cast<float>(point.x);
  cloud.xyz[3 * i + 1] = static_cast<float>(point.y);
  cloud.xyz[3 * i + 2] = static_cast<float>(point.z);
  cloud.object[i] = hit.object;
  cloud.ground[i] = ground && !reflected;
}

}  // namespace

std::string_view name_of(SynthObjectKind kind) {
  constexpr std::array<std::string_view, 9> names{"car",   "pedestrian", "pole",    "house", "wall",
                                                  "hedge", "tree",       "cyclist", "bridge"};
  return names[static_cast<std::size_t>(kind)];
}

std::size_t street_rays(std::size_t points, std::size_t beams) {
  return std::max<std::size_t>(1, (points + beams / 2) / beams) * beams;
}

StreetFrame make_street_frame(const StreetOptions& options, std::size_t frame) {
  const std::size_t rays = street_rays(options.points, options.beams);
  const std::size_t columns = rays / options.beams;
  const double step = static_cast<double>(street_beams) / static_cast<double>(options.beams);
  const std::vector<PlacedObject> objects = place_objects(options.seed, frame);
  const auto candidates = candidates_by_column(objects, columns);

  StreetFrame result;
  result.cloud.xyz.resize(3 * rays);
  result.cloud.object.resize(rays);
  result.cloud.ground.resize(rays);
  result.cloud.height = options.beams;
  for (std::size_t i = 0; i < rays; ++i) {
    const std::size_t row = i / columns;
    const auto [x, y, z] = street_beam(step * static_cast<double>(row), i % columns, columns);
    const Ray ray{{x, y, z}, SplitMix64({options.seed, frame, i}).next()};
    Hit hit;
    for (const ColumnCandidate& candidate : candidates[i % columns]) {
      if (candidate.min_range >= hit.range) break;
      cast(ray, *candidate.object, hit);
    }
    const double ground = cast_ground(ray);
    const bool on_ground = ground < hit.range;
    if (on_ground) hit = {ground, 0, 0};
    record(ray, hit, on_ground, result.cloud, i);
  }
  for (const PlacedObject& object : objects)
    result.objects.push_back(truth_of(object));
  return result;
}

std::array<double, 3> street_beam(double beam, std::size_t column, std::size_t columns) {
  const double degrees = beam < 32 ? 2 - beam / 3 : -8.83 - (beam - 32) * (24.8 - 8.83) / 31;
  const double elevation = degrees * std::numbers::pi / 180;
  const double azimuth = azimuth_of(static_cast<double>(column), columns);
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

double street_ground_height(double x, double y) {
  const double road = street_slope * x - street_sensor_height;
  return y < street_curb_left && y > street_curb_right ? road : road + street_curb_height;
}

}  // namespace pcl_bv
