// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The bounds that docs/numerics.md derives.

#include "projections_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "passing_points.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv {
namespace {

template <typename Vector>
Direction magnitudes(const Vector& v) {
  return {std::abs(v[0]), std::abs(v[1]), std::abs(v[2])};
}

Direction opposite_if(bool negative, const Direction& d) {
  return negative ? Direction{-d[0], -d[1], -d[2]} : d;
}

// How far the double dot product of a scaled direction and a point may be off: its own rounding, that of the
// direction's tiny components, underflow.
double double_doubt(const Direction& scaled, const Coordinates& p) {
  return (0x1p-50 * dot3(magnitudes(scaled), magnitudes(p)) + 0x1p-1074 * taxicab3(p)) + kSmallestNormal;
}

}  // namespace

void ProjectionSet::add(const Direction& direction) {
  if (count >= kMaxProjections) {
    throw std::invalid_argument("a set holds at most " + std::to_string(kMaxProjections) + " directions");
  }
  const Direction size = magnitudes(direction);
  const double largest = std::max({size[0], size[1], size[2]});
  // Sums say whether a component is a NaN, which a maximum may lose.
  if (!(largest >= 1e-30 && largest <= 1e30) || !std::isfinite((size[0] + size[1]) + size[2])) {
    throw std::invalid_argument("direction " + std::to_string(count) +
                                " must be finite with its largest component from 1e-30 to 1e30");
  }
  const int exponent = std::ilogb(largest);
  exact[count] = direction;
  scaled[count] = {std::ldexp(direction[0], -exponent), std::ldexp(direction[1], -exponent),
                   std::ldexp(direction[2], -exponent)};
  ++count;
}

Direction ProjectionSet::end_direction(std::size_t end) const {
  return opposite_if(end % 2 == 0, exact[end / 2]);
}

Direction ProjectionSet::scaled_end_direction(std::size_t end) const {
  return opposite_if(end % 2 == 0, scaled[end / 2]);
}

void keep_farthest(const Direction& direction, const FarthestPoint& other, FarthestPoint& best) {
  if (!other.found) return;
  // Many equal points (a cloud of one value, dead beams) need no arithmetic.
  const int order = !best.found                 ? 1
                    : other.point == best.point ? 0
                                                : compare_along(direction, other.point, best.point);
  if (order > 0 || (order == 0 && other.index < best.index)) best = other;
}

double surely_reached(const ProjectionSet& set, std::size_t end, const Coordinates& point) {
  const Direction scaled = set.scaled_end_direction(end);
  return dot3(scaled, point) - double_doubt(scaled, point);
}

bool central_point(const PointView& points, Coordinates& center) {
  Coordinates mean;
  if (!chunk_center(points, mean)) return false;
  constexpr std::size_t samples = 16;
  const std::size_t taken = std::min(samples, points.count);
  double nearest = kInfinity;
  const auto compete = [&](std::size_t i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) return;
    const double distance =
        std::max({std::abs(p.x - mean.x), std::abs(p.y - mean.y), std::abs(p.z - mean.z)});
    if (distance >= nearest) return;
    nearest = distance;
    center = p;
  };
  for (std::size_t s = 0; s < taken; ++s)
    compete((2 * s + 1) * points.count / (2 * taken));
  for (std::size_t i = 0; nearest == kInfinity; ++i)
    compete(i);
  return true;
}

ProjectionPlan::ProjectionPlan(const ProjectionSet& set, std::size_t direction, const Relief& relief,
                               ScalarType scalar)
    : is_float_(scalar == ScalarType::float32) {
  const double unit = is_float_ ? 0x1p-24 : kU;
  const double least = is_float_ ? 0x1p-149 : 0x1p-1074;
  const double greatest = is_float_ ? static_cast<double>(std::numeric_limits<float>::max()) : 1e300;
  const Direction& exact = set.exact[direction];
  const Direction& scaled = set.scaled[direction];
  const auto& s = relief.spread;
  const auto flat = [&](std::size_t axis) { return exact[axis] == 0 || s[axis] == 0; };
  constant_ = flat(0) && flat(1) && flat(2);  // p - c is 0 only if p is c
  const double size = dot3(magnitudes(scaled), s);
  overflow_ = !(size <= 0.99 * greatest);  // of infinite spreads it may be NaN
  const double doubt = 5.1 * unit * size + least * ((s[0] + s[1]) + s[2] + 4);
  band_ = 2 * doubt + unit * size;
  offset_ = dot3(scaled, relief.center);
  offset_doubt_ = doubt + 0x1p-49 * size + double_doubt(scaled, relief.center);
}

EndSearch ProjectionPlan::of(bool high, double top, double reached) const {
  if (constant_) return {EndSearch::Kind::every, 0};
  if (overflow_) return {EndSearch::Kind::some, -kInfinity};  // sums say nothing
  if (top + (high ? offset_ : -offset_) + offset_doubt_ < reached) return {EndSearch::Kind::none, 0};
  const double threshold = top - band_;
  return {EndSearch::Kind::some, is_float_ ? float_down(threshold) : threshold};
}

void find_farthest(const PointView& points, std::size_t first, std::size_t step, std::size_t end,
                   const Direction& direction, const Direction& scaled, const RoundedFilter& filter,
                   FarthestPoint& best) {
  const auto look = [&](const Coordinates& point, std::size_t index) {
    if (is_valid(point)) keep_farthest(direction, {true, point, index}, best);
  };
  if (points.scalar == ScalarType::float32) {
    for_each_passing<float>(points, first, step, end, scaled, filter, look);
  } else {
    for_each_passing<double>(points, first, step, end, scaled, filter, look);
  }
}

}  // namespace pcl_bv
