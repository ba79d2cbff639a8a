// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The rural road, the ground beside it, and the motion of the sensor's car.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcl_bv/synth/random.h"
#include "vec3.h"

namespace pcl_bv::rural_road {
using namespace detail;

/// Road coordinates: distance along the road and distance left of its middle, metres.
struct RoadPosition {
  double along, left;
};

/// Profile of the roadside. Each side of the road has one profile per stretch of 40 m.
enum class Roadside : std::uint8_t { kerb, ditch, verge };

/// The middle of the road as a curve, sampled from 200 m before to 200 m after the distance `around`.
class Road {
 public:
  Road(std::uint64_t seed, double around);

  Vec3 at(double along) const;         ///< Point of the road's middle, with z = 0.
  double heading(double along) const;  ///< Radians left of +x, -0.6 to 0.6.

  /// Returns the road coordinates of a point within 100 m of the road's middle, by an iterative search for
  /// the nearest point of the middle. `guess` is the initial distance along the road.
  RoadPosition road_position_of(double x, double y, double guess, int steps = 4) const;

  /// Returns the distance along the road of the first sample beyond `x`, as a guess for road_position_of().
  double guess(double x) const;

  static double curvature(std::uint64_t seed, double along);  ///< 1/m, positive to the left.

 private:
  struct Sample {
    double x, y, heading;
  };
  double begin_;
  std::vector<Sample> samples_;
};

/// Returns the distance that the sensor's car has driven after `seconds`, metres.
double driven_distance(std::uint64_t seed, double seconds);

class World {
 public:
  /// Creates the world for points within 100 m of the road's point at the distance `along`.
  World(std::uint64_t seed, double along);

  Road road;

  Roadside roadside_at(double along, bool left) const;

  /// Returns the height of the ground without its roughness, metres.
  double height(double x, double y) const;
  double height(double x, double y, const RoadPosition& position) const;

  /// Returns the unit normal of the ground, from height differences over 1.2 m.
  Vec3 normal(double x, double y) const;

  double roughness(const RoadPosition& position) const;  ///< Largest deviation from height(), metres.
  double grass(const RoadPosition& position) const;      ///< Height of the grass, metres; 0: none.

 private:
  double profile(double along, double left) const;
  double side_profile(Roadside side, std::uint64_t key, double away) const;

  std::uint64_t seed_;
  std::array<double, 3> phases_{};  // phases of the hills' sine waves
};

/// Grid of the ground heights around the sensor, including roughness, with ray casting.
class Terrain {
 public:
  Terrain(const World& world, std::uint64_t seed, double x, double y);

  /// Returns the height of the ground, interpolated bilinearly, metres. Outside the grid, returns -infinity.
  double height(double x, double y) const;

  /// Returns the range at which the ray hits the ground, metres. If there is no hit within 100 m, returns
  /// infinity.
  double cast(Vec3 origin, Vec3 direction) const;

  /// Returns the height of the grass, metres. If there is no grass, and outside the grid, returns 0.
  double grass(double x, double y) const;

 private:
  double x_, y_;
  std::vector<float> heights_, grass_;
};

}  // namespace pcl_bv::rural_road
