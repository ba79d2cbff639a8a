// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The robot drives on a circle of 15.3 m around the origin. Everything else keeps out of the ring between 12
// m and 18 m.

#include "pcl_bv/synth/rig_drive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "pcl_bv/synth/random.h"
#include "vec3.h"

namespace pcl_bv::detail {
namespace {

constexpr double kPi = std::numbers::pi, kMaxRange = 80, kMinRange = 0.3;
constexpr double kLowestBeam = -25 * kPi / 180, kHighestBeam = 15 * kPi / 180;
constexpr double kFieldOfView = 220 * kPi / 180;

struct Frame3 {
  Vec3 x, y, z, at;  // axes and origin

  Vec3 direction(Vec3 v) const { return v.x * x + v.y * y + v.z * z; }
  Vec3 point(Vec3 p) const { return at + direction(p); }
};

Frame3 frame_of(const RigPose& m) {
  return {{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, {m[3], m[7], m[11]}};
}

Frame3 joined(const Frame3& outer, const Frame3& inner) {
  return {outer.direction(inner.x), outer.direction(inner.y), outer.direction(inner.z),
          outer.point(inner.at)};
}

// Yaw, then pitch (positive: the nose goes down), about the moved axes.
RigPose pose_rows(Vec3 at, double yaw, double pitch) {
  const double c = std::cos(yaw), s = std::sin(yaw), cp = std::cos(pitch), sp = std::sin(pitch);
  return {c * cp, -s, c * sp, at.x, s * cp, c, s * sp, at.y, -sp, 0, cp, at.z};
}

RigObject box(RigObject::Kind kind, double x, double y, double yaw, double length, double width,
              double height) {
  return {kind, x, y, yaw, length, width, height, 0};
}

RigObject cylinder(RigObject::Kind kind, double x, double y, double radius, double height) {
  return {kind, x, y, 0, 0, 0, height, radius};
}

// A person walks to and fro on 6 m at 1.2 m/s.
double walked(double seconds, double phase) {
  const double round = std::fmod(1.2 * seconds + phase, 12.0);
  return (round < 6 ? round : 12 - round) - 3;
}

// Narrows [near, far] to the part of the ray with low <= from + t * step <= high.
bool clip(double from, double step, double low, double high, double& near, double& far) {
  if (step == 0) return from >= low && from <= high;
  const double a = (low - from) / step, b = (high - from) / step;
  near = std::max(near, std::min(a, b));
  far = std::min(far, std::max(a, b));
  return near <= far;
}

// Narrows [near, far] to the part of the ray within the radius of a vertical axis through the origin.
bool clip_circle(double x, double y, double dx, double dy, double radius, double& near, double& far) {
  const double a = dx * dx + dy * dy, b = x * dx + y * dy, c = x * x + y * y - radius * radius;
  if (a == 0) return c <= 0;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return false;
  const double root = std::sqrt(discriminant);
  near = std::max(near, (-b - root) / a);
  far = std::min(far, (-b + root) / a);
  return near <= far;
}

// Returns the distance along the ray of unit length, or infinity.
double hit(const RigObject& object, Vec3 from, Vec3 step) {
  const double c = std::cos(object.yaw), s = std::sin(object.yaw);
  const double px = from.x - object.x, py = from.y - object.y;
  const double x = c * px + s * py, y = c * py - s * px, dx = c * step.x + s * step.y,
               dy = c * step.y - s * step.x;
  double near = 0, far = kMaxRange;
  const bool across = object.radius > 0 ? clip_circle(x, y, dx, dy, object.radius, near, far)
                                        : clip(x, dx, -object.length / 2, object.length / 2, near, far) &&
                                              clip(y, dy, -object.width / 2, object.width / 2, near, far);
  const bool inside = across && clip(from.z, step.z, 0, object.height, near, far);
  return inside && near > 0 ? near : std::numeric_limits<double>::infinity();
}

}  // namespace

RigDrive::RigDrive(const RigDriveOptions& options) : options_(options) {
  const bool valid = options.speed > 0 && options.degrees_per_second > 0 && options.noise >= 0 &&
                     options.beams > 1 && options.columns > 0;
  if (!valid) throw std::invalid_argument("RigDrive: the numbers must be above 0");
  using Kind = RigObject::Kind;
  for (const double side : {-35.0, 35.0}) {
    standing_.push_back(box(Kind::wall, side, 0, 0, 0.3, 70, 4));
    standing_.push_back(box(Kind::wall, 0, side, 0, 70, 0.3, 4));
  }
  standing_.push_back(box(Kind::wall, 0, 0, 0.4, 12, 0.3, 3));
  SplitMix64 random({options.seed, 50});
  for (int i = 0; i < 12; ++i) {
    const double around = (i + random.uniform(-0.2, 0.2)) * kPi / 6, far = i % 2 == 0 ? 19.5 : 10;
    standing_.push_back(cylinder(Kind::pole, far * std::cos(around), far * std::sin(around), 0.1, 4));
  }
  for (int i = 0; i < 7; ++i) {
    const double around = (i + random.uniform(0.3, 0.7)) * 2 * kPi / 7;
    standing_.push_back(box(Kind::parked_car, 30.5 * std::cos(around), 30.5 * std::sin(around),
                            around + random.uniform(-0.3, 0.3), 4.4, 1.8, 1.5));
  }
}

RigPose RigDrive::pose(double seconds) const {
  const double turn = options_.degrees_per_second * kPi / 180, radius = options_.speed / turn,
               angle = turn * seconds;
  return pose_rows({radius * std::cos(angle), radius * std::sin(angle), 0}, angle + kPi / 2, 0);
}

RigPose RigDrive::mounting(std::size_t sensor) {
  return sensor == 0 ? pose_rows({1.5, 0.3, 0.9}, 0.1, 0.03) : pose_rows({-1.2, -0.2, 1.1}, kPi - 0.05, 0);
}

std::vector<RigObject> RigDrive::objects(double seconds) const {
  using Kind = RigObject::Kind;
  std::vector<RigObject> all = standing_;
  SplitMix64 random({options_.seed, 51});
  for (int i = 0; i < 5; ++i) {
    const double around = (i + random.uniform(0.2, 0.8)) * 2 * kPi / 5, phase = random.uniform(0, 12);
    const double along = walked(seconds, phase);
    all.push_back(cylinder(Kind::person, 21.5 * std::cos(around) - along * std::sin(around),
                           21.5 * std::sin(around) + along * std::cos(around), 0.25, 1.75));
  }
  for (int i = 0; i < 2; ++i) {  // against the robot's direction
    const double around = kPi * i - 6.0 / 24 * seconds + random.uniform(-0.3, 0.3);
    all.push_back(
        box(Kind::moving_car, 24 * std::cos(around), 24 * std::sin(around), around + kPi / 2, 4.4, 1.8, 1.5));
  }
  return all;
}

RigSweep RigDrive::sweep(std::size_t sensor, std::size_t number) const {
  RigSweep sweep;
  sweep.seconds = kRigSweepSeconds * static_cast<double>(number) + kRigDelays.at(sensor);
  const Frame3 mounted = frame_of(mounting(sensor));
  SplitMix64 random({options_.seed, 52, sensor, number});
  const auto columns = static_cast<double>(options_.columns), beams = static_cast<double>(options_.beams);
  for (std::size_t column = 0; column < options_.columns; ++column) {
    // A turn begins behind the sensor, so that what it measures is in one piece.
    const double part = (static_cast<double>(column) + 0.5) / columns, azimuth = kPi - 2 * kPi * part;
    if (std::abs(azimuth) > kFieldOfView / 2) continue;
    const double after = kRigSweepSeconds * part, now = sweep.seconds + (options_.rolling ? after : 0);
    const Frame3 frame = joined(frame_of(pose(now)), mounted);
    const std::vector<RigObject> around = objects(now);
    for (std::size_t beam = 0; beam < options_.beams; ++beam) {
      const double up = kLowestBeam + (kHighestBeam - kLowestBeam) * static_cast<double>(beam) / (beams - 1);
      const Vec3 ray{std::cos(up) * std::cos(azimuth), std::cos(up) * std::sin(azimuth), std::sin(up)};
      const Vec3 step = frame.direction(ray);
      double range = step.z < 0 ? -frame.at.z / step.z : std::numeric_limits<double>::infinity();
      std::uint32_t object = 0;
      for (std::size_t i = 0; i < around.size(); ++i) {
        const double distance = hit(around[i], frame.at, step);
        if (distance >= range) continue;
        range = distance;
        object = static_cast<std::uint32_t>(i + 1);
      }
      const bool returns = range > kMinRange && range < kMaxRange;
      const double measured = returns ? range + options_.noise * random.normal() : 0;
      for (const double coordinate : {measured * ray.x, measured * ray.y, measured * ray.z})
        sweep.xyz.push_back(static_cast<float>(coordinate));
      sweep.ring.push_back(static_cast<std::uint16_t>(beam));
      sweep.time_ns.push_back(static_cast<std::uint32_t>(std::llround(1e9 * after)));
      sweep.object.push_back(returns ? object : 0);
    }
  }
  return sweep;
}

}  // namespace pcl_bv::detail
