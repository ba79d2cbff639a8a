// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The road, the ground beside it, and how the sensor's car drives.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcl_bv/synth/random.h"
#include "vec3.h"

namespace pcl_bv::verges {

/// A place along the road and to the left of its middle, metres.
struct RoadPlace {
  double along, left;
};

/// What is beside the road, in stretches of 40 m for each side.
enum class Side : std::uint8_t { kerb, ditch, verge };

/// The middle of the road as a curve, from 200 m behind a place to 200 m ahead of it.
class Road {
 public:
  Road(std::uint64_t seed, double around);

  Vec3 at(double along) const;         ///< Its z is 0.
  double heading(double along) const;  ///< Radians left of +x; at most 0.6 either way.

  /// Of a point within 100 m of the place, by the nearest point of the middle. `guess`: where to look first.
  RoadPlace place_of(double x, double y, double guess, int steps = 4) const;
  double guess(double x) const;

  static double curvature(std::uint64_t seed, double along);

 private:
  struct Sample {
    double x, y, heading;
  };
  double begin_;
  std::vector<Sample> samples_;
};

/// How far the sensor's car has come, metres, after some seconds.
double driven(std::uint64_t seed, double seconds);

class World {
 public:
  /// For places within 100 m of the road there.
  World(std::uint64_t seed, double along);

  Road road;

  Side side_of(double along, bool left) const;

  /// Height of the ground, smooth.
  double height(double x, double y) const;
  double height(double x, double y, const RoadPlace& place) const;

  /// Unit normal of the ground, over about a metre.
  Vec3 normal(double x, double y) const;

  /// Of a place: standard deviation of its roughness, and height of its grass (0: none), metres.
  double roughness(const RoadPlace& place) const;
  double grass(const RoadPlace& place) const;

 private:
  double profile(double along, double left) const;
  double side_profile(Side side, std::uint64_t key, double away) const;

  std::uint64_t seed_;
  std::array<double, 3> phases_{};  // of the hills
};

/// Heights of the ground about the sensor with its roughness, and rays against it.
class Terrain {
 public:
  Terrain(const World& world, std::uint64_t seed, double x, double y);

  double height(double x, double y) const;

  /// Range at which the ray meets the ground; infinity if never within 100 m.
  double cast(Vec3 origin, Vec3 direction) const;

  /// Grass there, metres; 0: none.
  double grass(double x, double y) const;

 private:
  double x_, y_;
  std::vector<float> heights_, grass_;
};

}  // namespace pcl_bv::verges
