// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Intersects rays with convex solids in the object's frame. Each solid gives one interval of ranges.
#include "street_cast.h"

#include <algorithm>
#include <cmath>

namespace pcl_bv::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The interval of ranges in which a ray is inside a convex solid; empty if enter >= exit.
struct Span {
  double enter = 0;
  double exit = infinity;

  bool empty() const { return !(enter < exit); }
};

struct LocalRay {
  Vec3 origin, direction;

  Vec3 at(double range) const { return origin + range * direction; }
};

/// Clips the span to the ranges at which the ray is inside a half-space, that is, speed * range is at most
/// `distance`. `speed` is the component of the ray's direction along the plane's outward normal. `distance`
/// is the signed distance from the ray's origin to the plane, positive inside.
void clip(Span& span, double speed, double distance) {
  if (speed > 0) {
    span.exit = std::min(span.exit, distance / speed);
  } else if (speed < 0) {
    span.enter = std::max(span.enter, distance / speed);
  } else if (distance < 0) {
    span.exit = -infinity;
  }
}

Span clip_box(const LocalRay& ray, const Box3& box) {
  Span span;
  clip(span, ray.direction.x, box.hi.x - ray.origin.x);
  clip(span, -ray.direction.x, ray.origin.x - box.lo.x);
  clip(span, ray.direction.y, box.hi.y - ray.origin.y);
  clip(span, -ray.direction.y, ray.origin.y - box.lo.y);
  clip(span, ray.direction.z, box.hi.z - ray.origin.z);
  clip(span, -ray.direction.z, ray.origin.z - box.lo.z);
  return span;
}

Span clip_half_spaces(const LocalRay& ray, const std::vector<SolidHalfSpace>& half_spaces) {
  Span span;
  for (const SolidHalfSpace& half_space : half_spaces) {
    clip(span, dot(half_space.normal, ray.direction), half_space.offset - dot(half_space.normal, ray.origin));
    if (span.empty()) break;
  }
  return span;
}

/// Solves |origin + range direction|^2 = 1 for the range, in the frame in which the ellipsoid is the unit
/// ball.
Span clip_ellipsoid(const LocalRay& ray, const Box3& bounds) {
  const Vec3 center = 0.5 * (bounds.lo + bounds.hi);
  const Vec3 radii = 0.5 * (bounds.hi - bounds.lo);
  const auto scaled = [&radii](Vec3 v) { return Vec3{v.x / radii.x, v.y / radii.y, v.z / radii.z}; };
  const Vec3 origin = scaled(ray.origin - center);
  const Vec3 direction = scaled(ray.direction);
  const double a = dot(direction, direction);
  const double b = dot(origin, direction);
  const double discriminant = b * b - a * (dot(origin, origin) - 1);
  if (discriminant <= 0) return {0, -infinity};
  const double root = std::sqrt(discriminant);
  return {std::max(0.0, (-b - root) / a), (-b + root) / a};
}

/// Returns the range at which the part stops the ray, or infinity.
double cast_part(const LocalRay& ray, const Part& part, std::uint64_t key) {
  const Span span =
      part.half_spaces.empty() ? clip_ellipsoid(ray, part.bounds) : clip_half_spaces(ray, part.half_spaces);
  if (span.empty()) return infinity;
  if (part.free_path > 0) {
    const double depth = -part.free_path * std::log(1.0 - SplitMix64(key).uniform());
    return span.enter + depth < span.exit ? span.enter + depth : infinity;
  }
  const Vec3 entry = ray.at(span.enter);
  for (const Box3& pocket : part.pockets) {
    if (!contains_point(pocket, entry)) continue;
    const double end = clip_box(ray, pocket).exit;
    // If a pocket at the solid's edge contains the rest of the ray's span, the ray passes through.
    if (end >= span.exit) return infinity;
    return end;
  }
  return span.enter;
}

}  // namespace

void cast(const Ray& ray, const PlacedObject& object, Hit& hit) {
  const LocalRay local{object.to_local(Vec3{} - object.base), object.to_local(ray.direction)};
  const Span span = clip_box(local, object.model.bounds);
  if (span.empty() || span.enter >= hit.range) return;
  std::uint64_t key = ray.key ^ object.id;
  for (const Part& part : object.model.parts) {
    const double range = cast_part(local, part, ++key);
    if (range < hit.range) hit = {range, object.id, part.loss_probability};
  }
}

double cast_ground(const Ray& ray) {
  const Vec3 d = ray.direction;
  const double descent_rate = street_slope * d.x - d.z;  // towards the ground, metres per metre of range
  const auto on_road = [&d](double range) {
    return range * d.y < street_curb_left && range * d.y > street_curb_right;
  };
  double nearest = infinity;
  if (descent_rate > 0) {
    const double sidewalk = (street_sensor_height - street_curb_height) / descent_rate;
    const double road = street_sensor_height / descent_rate;
    if (!on_road(sidewalk)) nearest = sidewalk;
    if (on_road(road)) nearest = std::min(nearest, road);
  }
  // The ray hits a curb face if its height at the curb's y is between road and sidewalk.
  const double curb = (d.y > 0 ? street_curb_left : street_curb_right) / d.y;
  const double height = street_sensor_height - descent_rate * curb;
  if (height >= 0 && height <= street_curb_height) nearest = std::min(nearest, curb);
  return nearest;
}

}  // namespace pcl_bv::detail
