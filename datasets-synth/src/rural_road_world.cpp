// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "rural_road_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace pcl_bv::rural_road {
using namespace detail;
namespace {

constexpr double kBend = 60;             // metres from one bend of the road to the next
constexpr double kCurvature = 0.045;     // 1/m; gives 30 degrees per second at 11.6 m/s
constexpr double kClothoid = 4;          // metres over which the curvature of a bend rises and falls
constexpr double kSample = 0.25;         // metres between two samples of the road
constexpr double kRoadHalfLength = 200;  // metres of sampled road, ahead and behind
constexpr double kStretch = 40;          // metres of road with the same Roadside
constexpr double kBlend = 3;             // metres over which one Roadside changes to the next
constexpr double kKerb = 4;              // metres from the middle of the road
constexpr double kKerbHeight = 0.12;     // metres
constexpr double kDitchMiddle = 7, kDitchHalfWidth = 1.3;

// Returns a number uniform in [0, 1) that depends only on the seed, the purpose and the index.
double keyed_uniform(std::uint64_t seed, std::uint64_t purpose, std::int64_t index) {
  return SplitMix64({seed, purpose, static_cast<std::uint64_t>(index)}).uniform();
}

// Returns the heading after a bend, radians. Headings alternate between left and right, so that the road
// keeps its mean direction and never crosses itself.
double heading_after(std::uint64_t seed, std::int64_t bend) {
  const double size = 0.35 + 0.23 * keyed_uniform(seed, 1, bend);
  return bend % 2 == 0 ? size : -size;
}

// Smoothstep: 3 t^2 - 2 t^3 for t clamped to [0, 1].
double smooth(double t) {
  const double u = std::clamp(t, 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

}  // namespace

double Road::curvature(std::uint64_t seed, double along) {
  const double bend = std::floor(along / kBend), local = along - bend * kBend;
  const auto number = static_cast<std::int64_t>(bend);
  const double turn = heading_after(seed, number) - heading_after(seed, number - 1);
  const double length = std::abs(turn) / kCurvature + kClothoid;
  const double shape = std::min({1.0, local / kClothoid, (length - local) / kClothoid});
  return shape <= 0 ? 0 : std::copysign(kCurvature * shape, turn);
}

// Integrates the curvature from a fixed start, so that the road is the same in every frame.
Road::Road(std::uint64_t seed, double around) {
  double heading = heading_after(seed, -1 - static_cast<std::int64_t>(kRoadHalfLength / kBend) - 1);
  const double origin = -kBend * (std::floor(kRoadHalfLength / kBend) + 1);
  begin_ = around - kRoadHalfLength;
  double x = origin, y = 0;
  const auto steps = static_cast<std::int64_t>((around + kRoadHalfLength - origin) / kSample);
  for (std::int64_t i = 0; i < steps; ++i) {
    const double along = origin + kSample * static_cast<double>(i);
    if (along >= begin_) {
      if (samples_.empty()) begin_ = along;
      samples_.push_back({x, y, heading});
    }
    const double turned = heading + 0.5 * kSample * curvature(seed, along + 0.25 * kSample);
    x += kSample * std::cos(turned);
    y += kSample * std::sin(turned);
    heading += kSample * curvature(seed, along + 0.5 * kSample);
  }
}

Vec3 Road::at(double along) const {
  const double index = std::clamp((along - begin_) / kSample, 0.0, static_cast<double>(samples_.size() - 2));
  const auto i = static_cast<std::size_t>(index);
  const double t = index - static_cast<double>(i);
  const Sample &a = samples_[i], &b = samples_[i + 1];
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), 0};
}

double Road::heading(double along) const {
  const double index = std::clamp((along - begin_) / kSample, 0.0, static_cast<double>(samples_.size() - 2));
  const auto i = static_cast<std::size_t>(index);
  const double t = index - static_cast<double>(i);
  return samples_[i].heading + t * (samples_[i + 1].heading - samples_[i].heading);
}

double Road::guess(double x) const {
  const auto after = std::upper_bound(samples_.begin(), samples_.end(), x,
                                      [](double value, const Sample& sample) { return value < sample.x; });
  return begin_ + kSample * static_cast<double>(after - samples_.begin());
}

RoadPosition Road::road_position_of(double x, double y, double guess, int steps) const {
  double along = guess;
  for (int i = 0; i < steps; ++i) {
    const Vec3 middle = at(along);
    const double angle = heading(along);
    along += 0.9 * ((x - middle.x) * std::cos(angle) + (y - middle.y) * std::sin(angle));
  }
  const Vec3 middle = at(along);
  const double angle = heading(along);
  return {along, (y - middle.y) * std::cos(angle) - (x - middle.x) * std::sin(angle)};
}

// The car drives in cycles of 18 s: 4 s acceleration, 9 s at constant speed, 3 s braking, then 2 s at
// standstill (even cycles) or at 3 m/s (odd cycles).
double driven_distance(std::uint64_t seed, double seconds) {
  constexpr double kCycle = 18;
  double distance = 0;
  for (std::int64_t cycle = 0; kCycle * static_cast<double>(cycle) < seconds; ++cycle) {
    const double begin = kCycle * static_cast<double>(cycle);
    const double top = 8 + 4 * keyed_uniform(seed, 2, std::llround(begin));
    const double slow = cycle % 2 == 0 ? 0 : 3;
    const double before = cycle % 2 == 0 ? 3 : 0;
    const double t = std::min(seconds - begin, kCycle);
    const double up = std::min(t, 4.0), on = std::clamp(t - 4, 0.0, 9.0);
    const double down = std::clamp(t - 13, 0.0, 3.0), still = std::max(t - 16, 0.0);
    distance += (before + (top - before) * up / 8) * up + top * on + (top - (top - slow) * down / 6) * down +
                slow * still;
  }
  return distance;
}

World::World(std::uint64_t seed, double along) : road(seed, along), seed_(seed) {
  for (std::size_t i = 0; i < phases_.size(); ++i)
    phases_[i] = 2 * std::numbers::pi * keyed_uniform(seed, 7, static_cast<std::int64_t>(i));
}

Roadside World::roadside_at(double along, bool left) const {
  const auto stretch = static_cast<std::int64_t>(std::floor(along / kStretch));
  return static_cast<Roadside>(static_cast<int>(3 * keyed_uniform(seed_, left ? 3 : 4, stretch)));
}

double World::side_profile(Roadside side, std::uint64_t key, double away) const {
  if (side == Roadside::kerb) return kKerbHeight * smooth((away - kKerb) / 0.1);
  if (side == Roadside::verge) return 0;
  const double depth = 0.3 + 0.5 * SplitMix64(key).uniform();
  const double t = std::abs(away - kDitchMiddle) / kDitchHalfWidth;
  return t < 1 ? -0.5 * depth * (1 + std::cos(std::numbers::pi * t)) : 0;
}

// Returns the height of the road's cross-section, without the hills. The road has a camber of 2 % down to
// both kerbs. The profile of the roadside begins at the kerb. Over the first kBlend metres of a stretch, its
// profile is blended with the profile of the previous stretch.
double World::profile(double along, double left) const {
  const double away = std::abs(left);
  const double camber = -0.02 * std::min(away, kKerb);
  if (away <= kKerb) return camber;
  const double stretch = std::floor(along / kStretch);
  const double into = along - stretch * kStretch;
  const auto key = [&](double of) {
    return SplitMix64({seed_, left > 0 ? 5U : 6U, static_cast<std::uint64_t>(static_cast<std::int64_t>(of))})
        .next();
  };
  const double own = side_profile(roadside_at(along, left > 0), key(stretch), away);
  const double blend = 1 - smooth(into / kBlend);  // weight of the previous stretch
  if (blend == 0) return camber + own;
  const double last = side_profile(roadside_at(along - kBlend, left > 0), key(stretch - 1), away);
  return camber + own + blend * (last - own);
}

double World::height(double x, double y, const RoadPosition& position) const {
  const double hills = 4.2 * std::sin(x / 36 + phases_[0]) + 1.2 * std::sin(y / 25 + phases_[1]) +
                       0.35 * std::sin((x + y) / 13 + phases_[2]);
  return hills + profile(position.along, position.left);
}

double World::height(double x, double y) const {
  return height(x, y, road.road_position_of(x, y, road.guess(x)));
}

Vec3 World::normal(double x, double y) const {
  constexpr double d = 0.6;
  return normalized(
      {(height(x - d, y) - height(x + d, y)) / (2 * d), (height(x, y - d) - height(x, y + d)) / (2 * d), 1});
}

double World::roughness(const RoadPosition& position) const {
  const double away = std::abs(position.left);
  const bool paved =
      away < kKerb || (away < 8 && roadside_at(position.along, position.left > 0) == Roadside::kerb);
  return paved ? 0.003 : away < 8 ? 0.02 : 0.04;
}

// Grass is short within 5.5 m of the middle of the road and highest where the roadside is a ditch.
double World::grass(const RoadPosition& position) const {
  const double away = std::abs(position.left);
  const Roadside side = roadside_at(position.along, position.left > 0);
  if (away < kKerb + 0.2 || (away < 8 && side == Roadside::kerb)) return 0;
  return away < 5.5 ? 0.06 : side == Roadside::ditch ? 0.22 : 0.12;
}

namespace {

constexpr double kCell = 0.25;  // metres between two grid nodes
constexpr double kHalf = 104;   // metres from the sensor to the edge of the grid
constexpr auto kSide = static_cast<std::size_t>(2 * kHalf / kCell);

}  // namespace

// Grid nodes are at multiples of kCell in the fixed frame, so that the roughness is the same in every frame.
Terrain::Terrain(const World& world, std::uint64_t seed, double x, double y)
    : x_(std::floor((x - kHalf) / kCell) * kCell), y_(std::floor((y - kHalf) / kCell) * kCell) {
  heights_.resize(kSide * kSide);
  grass_.resize(kSide * kSide);
  const double left = std::round(x_ / kCell), low = std::round(y_ / kCell);
  for (std::size_t i = 0; i < kSide; ++i) {
    const double at = x_ + kCell * static_cast<double>(i);
    RoadPosition position{world.road.guess(at), 0};
    for (std::size_t k = 0; k < kSide; ++k) {
      const double across = y_ + kCell * static_cast<double>(k);
      // Two steps are enough, because the guess is the result of the previous node, which is only 0.25 m
      // away.
      position = world.road.road_position_of(at, across, position.along, 2);
      const auto column =
          static_cast<std::uint64_t>(static_cast<std::int64_t>(left) + static_cast<std::int64_t>(i));
      const auto row =
          static_cast<std::uint64_t>(static_cast<std::int64_t>(low) + static_cast<std::int64_t>(k));
      SplitMix64 random({seed, column, row});
      const double rough = world.roughness(position) * random.uniform(-1, 1);
      heights_[i * kSide + k] = static_cast<float>(world.height(at, across, position) + rough);
      grass_[i * kSide + k] = static_cast<float>(world.grass(position));
    }
  }
}

double Terrain::height(double x, double y) const {
  const double u = (x - x_) / kCell, v = (y - y_) / kCell;
  if (!(u >= 0 && v >= 0 && u < kSide - 1 && v < kSide - 1)) return -std::numeric_limits<double>::infinity();
  const auto i = static_cast<std::size_t>(u), k = static_cast<std::size_t>(v);
  const double s = u - static_cast<double>(i), t = v - static_cast<double>(k);
  const float* const at = heights_.data() + i * kSide + k;
  const double low = at[0] + t * (double{at[1]} - at[0]),
               high = at[kSide] + t * (double{at[kSide + 1]} - at[kSide]);
  return low + s * (high - low);
}

double Terrain::grass(double x, double y) const {
  const double u = (x - x_) / kCell, v = (y - y_) / kCell;
  if (!(u >= 0 && v >= 0 && u < kSide && v < kSide)) return 0;
  return grass_[static_cast<std::size_t>(u) * kSide + static_cast<std::size_t>(v)];
}

// Marches along the ray, then bisects. If the slope of the ground is at most 1, the ray's height above the
// ground decreases by at most `speed` per metre of range. A step of `clearance / speed` then misses no
// ground, where `clearance` is the ray's height above the ground. Only on the banks of ditches can the slope
// exceed 1, and a step may miss an edge there.
double Terrain::cast(Vec3 origin, Vec3 direction) const {
  const double level = std::hypot(direction.x, direction.y);
  const double speed = 1.0 * level + std::abs(direction.z);
  const auto above = [&](double range) {
    const Vec3 p = origin + range * direction;
    return p.z - height(p.x, p.y);
  };
  double range = 0, last = 0;
  double clearance = above(0);
  while (clearance > 0) {
    last = range;
    range += std::max(0.1, clearance / speed);
    if (range > 100 || (direction.z > 0 && clearance > 12)) return std::numeric_limits<double>::infinity();
    clearance = above(range);
  }
  double under = range;
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (last + under);
    (above(middle) > 0 ? last : under) = middle;
  }
  return under;
}

}  // namespace pcl_bv::rural_road
